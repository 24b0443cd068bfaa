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
  std::size_t max_reasons = 5;  ///< Reasons for failures that are shown, the most frequent first.
  std::size_t max_scenes = 12;  ///< Rows of the table per scene; the worst are kept.
};

/// What `croon run` and `croon merge` print: the tables of the summary, of the basin and of the
/// claims.
std::string result_text(const Results& results, bool colours);

/// The tables of a summary, in UTF-8, within 120 columns for names of ordinary length: success and
/// mean ± std per DOF of every variant and sensor, every variant against the first, loops, success
/// per kind of scene and per scene, reasons for failures. Ends with a newline.
std::string summary_text(const Summary& summary, const TableStyle& style = {});

/// Success in % per variant, kind of scene (rows) and sensor (columns).
std::string scene_kind_text(const Summary& summary, const TableStyle& style);

/// Success per variant, scene (rows) and sensor (columns). Of more than `style.max_scenes` rows the
/// worst are shown, in their order.
std::string scene_text(const Summary& summary, const TableStyle& style);

/// Success in % per variant (rows) and level (columns), all sensors together, and the radius; of
/// many levels every second, third, ... is shown. Ends with a newline.
std::string basin_text(const Basin& basin, const TableStyle& style = {});

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
