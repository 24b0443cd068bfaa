#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/results.hpp"
#include "framework/calibration/rig_view.hpp"
#include "framework/document/document.hpp"

namespace croon::experiments {

/// The clouds of a trial, at its initial guess and its result.
struct TrialView {
  std::string why;  ///< Why the trial is shown: "the largest error of an accepted pose".
  const TrialRecord* record = nullptr;  ///< In Results::records.
  RigView view;
  std::vector<Chart> charts = {};  ///< Around the result.
};

/// The report of an experiment: what it asks and found, its pipelines, charts, and trials to look
/// at. `without_views` is why `views` is empty; it may be empty.
Document experiment_report(const Results& results, const std::vector<TrialView>& views,
                           const std::string& without_views);

/// The steps of the variants as boxes; steps that differ from the first variant are marked.
/// `manifest` is the JSON of manifest.json.
Drawing pipeline_chart(const std::string& manifest, const Sheet& sheet = {});

}  // namespace croon::experiments
