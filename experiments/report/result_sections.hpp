#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/analysis/results.hpp"
#include "experiments/run/pipeline_tree.hpp"
#include "framework/document/document.hpp"
#include "framework/pipeline/cloud_description.hpp"

namespace croon::experiments {

// The results as sections, without figures. A section has no blocks if these results lack what it
// shows. As text, tables are at most 120 columns wide for names of ordinary length.

/// Success and errors of every variant and sensor, followed by sections on frames, degrees of
/// freedom, comparisons with the first variant, loops, kinds of scenes, scenes, poses and reasons.
Section summary_section(const Results& results);

/// The numbers of right and wrong poses, accepted and rejected, per variant and sensor, at the
/// success bounds.
Section verdicts_section(const Results& results);

/// How often intervals of covariances contain ground truth, per variant and degree of freedom, over
/// all sensors.
Section coverage_section(const Results& results);

/// Success in % per variant (rows) and level (columns), over all sensors, and the radius; of many
/// levels only every n-th is shown.
Section basin_section(const Results& results);

/// The claims of the experiment: expected, band, found and verdict, and the reasons why ours may
/// differ.
Section claims_section(const Results& results);

/// Rows of other methods as published, each statistic followed by ours.
Section quoted_section(const Results& results);

/// Remarks on the builds that made the trials.
Section builds_section(const Results& results);

/// The sections above that are not empty, in this order.
std::vector<Section> result_sections(const Results& results);

/// The output of `croon run` and `croon merge`.
std::string result_text(const Results& results, bool colours);

/// The page of `croon claims` on one folder of results: the run and its builds, its claims, and the
/// rows of other methods.
Section claims_page(const Results& results);

/// A table of clouds with a row per sensor and dataset: medians over scenes, followed by minimum
/// and maximum if there are several scenes.
Section clouds_section(const std::vector<CloudDescription>& clouds);

/// The work of a run.
struct PlanCounts {
  std::size_t starts = 0;  ///< Over all scenes and sensors.
  std::size_t trials = 0;  ///< Every start counts once per variant.
  std::size_t done = 0;    ///< Trials already in the store.
  std::vector<StepCount> steps;
};

/// For `croon run --plan`: how often each step runs, and how many runs are saved because variants
/// share it.
Section plan_section(const PlanCounts& plan);

}  // namespace croon::experiments
