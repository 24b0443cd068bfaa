#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/analysis/basin.hpp"
#include "experiments/analysis/results.hpp"
#include "experiments/run/pipeline_tree.hpp"
#include "framework/pipeline/cloud_description.hpp"

namespace croon::experiments {

/// How `croon run` shows a summary.
struct TableStyle {
  bool colours = false;         ///< Only if the output is a terminal.
  std::size_t max_reasons = 5;  ///< Reasons of trials that are shown, the most frequent first.
  std::size_t max_scenes = 12;  ///< Rows of the table per scene; the worst are kept.
};

/// What `croon run` and `croon merge` print: the tables of the summary, of the basin and of the
/// claims.
std::string result_text(const Results& results, bool colours);

/// The tables of a summary, in UTF-8, within 120 columns for names of ordinary length: success and
/// mean ± std per DOF of every variant and sensor, every variant against the first, loops, success
/// per kind of scene and per scene, reasons of trials. Ends with a newline.
std::string summary_text(const Summary& summary, const TableStyle& style = {});

/// Right and wrong poses against accepted and rejected ones, per variant and sensor, at the bounds
/// of success. Ends with a newline.
std::string verdicts_text(const Verdicts& verdicts, const TableStyle& style = {});

/// How often the intervals of covariances hold the truth, per variant and degree of freedom, all
/// sensors together. Ends with a newline.
std::string coverage_text(const Coverage& coverage, const TableStyle& style = {});

/// Success in % per variant (rows) and level (columns), all sensors together, and the radius; of
/// many levels every second, third, ... is shown. Ends with a newline.
std::string basin_text(const Basin& basin, const TableStyle& style = {});

/// What `croon run` prints of the claims: claim, source, expected, band, found and verdict, then
/// the quoted rows with ours beside them. Empty if there are none of either.
std::string claims_text(const std::vector<ClaimResult>& results, const std::vector<Quoted>& quoted,
                        const Summary& summary, const TableStyle& style = {});

/// The same as Markdown, with the reasons why ours may differ below the table.
std::string claims_markdown(const std::vector<ClaimResult>& results,
                            const std::vector<Quoted>& quoted, const Summary& summary);

/// The page of `croon claims` on one folder of results, a section of Markdown: what was run, its
/// claims, and the quoted rows of other methods.
std::string claims_section(const Results& results);

/// A table of clouds with a row per sensor and dataset: the medians over scenes, with the least and
/// the largest after them if there are several scenes.
std::string clouds_text(const std::vector<CloudDescription>& clouds);

/// What a run has to do.
struct PlanCounts {
  std::size_t starts = 0;  ///< Of all scenes and sensors.
  std::size_t trials = 0;  ///< Starts, each with its variants.
  std::size_t done = 0;    ///< Trials that the store has.
  std::vector<StepCount> steps;
};

/// For `croon run --plan`: how often each step will run, and how often variants share it.
std::string plan_text(const PlanCounts& plan, bool colours);

}  // namespace croon::experiments
