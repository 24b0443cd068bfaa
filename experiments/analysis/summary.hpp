#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/analysis/comparison.hpp"
#include "experiments/analysis/loops.hpp"
#include "experiments/analysis/trial_summary.hpp"
#include "experiments/run/sensor_pairs.hpp"

namespace croon::experiments {

/// The order of rows and scenes in every report. A name that records have and the order lacks comes
/// last.
struct ReportOrder {
  std::vector<std::string> variants;
  std::vector<std::string> sensors;
  std::vector<std::string> scenes;
  std::map<std::string, std::string> scene_kinds;  ///< By scene; not all scenes have one.
  std::vector<SensorPair> pairs = {};              ///< Of sensors that are pairs of others.
};

/// `names`, then in alphabetical order those that records have as `name` and `names` lacks.
std::vector<std::string> completed(std::vector<std::string> names,
                                   const std::vector<TrialRecord>& records,
                                   std::string TrialId::*name);

/// One variant and sensor in all scenes of one kind.
struct SceneKindSummary : TrialSummary {
  std::string variant;
  std::string scene_kind;
  std::string sensor;  ///< Empty for all sensors together.
  int scenes = 0;
};

/// A reason why trials ended as `rejected` or `failed`, and their number.
struct ReasonCount {
  std::string variant;
  Status status = Status::failed;
  std::string reason;
  int count = 0;
};

/// The results of an experiment.
struct Summary {
  SuccessBounds bounds;
  std::vector<SummaryRow> rows;               ///< By variant, then sensor.
  std::vector<SceneKindSummary> scene_kinds;  ///< By variant, kind and sensor, all together last;
                                              ///< empty if no scene has a kind.
  std::vector<Comparison> comparisons;  ///< With the first variant: by variant, then sensor, all.
  std::vector<LoopClosure> loops;       ///< By variant, then pair.
  std::vector<ReasonCount> reasons;     ///< The most frequent first.
};

/// Sums the records up. The order of the records makes no difference.
Summary summarise(const std::vector<TrialRecord>& records, const SuccessBounds& bounds,
                  const ReportOrder& order);

/// The variants of the summary, and its sensors, each once, in its order.
std::vector<std::string> variants_of(const Summary& summary);
std::vector<std::string> sensors_of(const Summary& summary);

/// The rows of a variant, of all its sensors if `sensor` is empty.
std::vector<const SummaryRow*> rows_of(const Summary& summary, const std::string& variant,
                                       const std::string& sensor = "");

}  // namespace croon::experiments
