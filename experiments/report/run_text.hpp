#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/analysis/basin.hpp"
#include "experiments/analysis/results.hpp"
#include "experiments/run/pipeline_tree.hpp"
#include "framework/pipeline/cloud_description.hpp"

namespace croon::experiments {

/// The style of the tables that `croon run` prints.
struct TableStyle {
  bool colours = false;         ///< Only if the output is a terminal.
  std::size_t max_reasons = 5;  ///< Number of shown reasons of trials, the most frequent first.
  std::size_t max_scenes = 12;  ///< Number of rows of the table per scene; the worst are shown.
};

/// The output of `croon run` and `croon merge`: the tables of the summary, of the basin and of the
/// claims.
std::string result_text(const Results& results, bool colours);

/// The tables of a summary, in UTF-8, at most 120 columns wide for names of ordinary length:
/// success and mean ± std per DOF of every variant and sensor, every variant against the first,
/// loops, success per kind of scene and per scene, reasons of trials. Ends with a newline.
std::string summary_text(const Summary& summary, const TableStyle& style = {});

/// The numbers of right and wrong poses, accepted and rejected, per variant and sensor, at the
/// success bounds. Ends with a newline.
std::string verdicts_text(const AcceptanceCurve& acceptance, const TableStyle& style = {});

/// How often intervals of covariances contain ground truth, per variant and degree of freedom, over
/// all sensors. Ends with a newline.
std::string coverage_text(const Coverage& coverage, const TableStyle& style = {});

/// Success in % per variant (rows) and level (columns), over all sensors, and the radius; of many
/// levels only every n-th is shown. Ends with a newline.
std::string basin_text(const Basin& basin, const TableStyle& style = {});

/// The output of `croon run` on claims: claim, source, expected, band, found and verdict, then the
/// quoted rows followed by ours. Empty if there are neither claims nor quoted rows.
std::string claims_text(const std::vector<ClaimResult>& results, const std::vector<Quoted>& quoted,
                        const Summary& summary, const TableStyle& style = {});

/// The same as Markdown, with the reasons why ours may differ below the table.
std::string claims_markdown(const std::vector<ClaimResult>& results,
                            const std::vector<Quoted>& quoted, const Summary& summary);

/// The page of `croon claims` on one folder of results, a section of Markdown: the run, its claims,
/// and the quoted rows of other methods.
std::string claims_section(const Results& results);

/// A table of clouds with a row per sensor and dataset: medians over scenes, followed by minimum
/// and maximum if there are several scenes.
std::string clouds_text(const std::vector<CloudDescription>& clouds);

/// The work of a run.
struct PlanCounts {
  std::size_t starts = 0;  ///< Over all scenes and sensors.
  std::size_t trials = 0;  ///< Every start counts once per variant.
  std::size_t done = 0;    ///< Trials already in the store.
  std::vector<StepCount> steps;
};

/// For `croon run --plan`: how often each step runs, and how many runs are saved because variants
/// share it.
std::string plan_text(const PlanCounts& plan, bool colours);

}  // namespace croon::experiments
