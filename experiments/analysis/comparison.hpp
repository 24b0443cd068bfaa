#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/trial_summary.hpp"

namespace croon::experiments {

/// The result of a paired test; its p values are two-sided.
struct PairedTest {
  bool favours_variant = false;  ///< Whether the sum of the test's scores is on its side.
  double p = 1.0;                ///< If every trial is independent.
  double p_holm = 1.0;           ///< The same, corrected for all tests of the sensor (Holm 1979).
  double p_by_scene = 1.0;       ///< If scenes are the independent units.
  double p_by_scene_holm = 1.0;
};

/// Whether the difference is significant over trials: corrected p below 0.05.
bool is_significant(const PairedTest& test);

/// Whether the difference is significant over trials and with scenes as units.
bool holds_by_scene(const PairedTest& test);

/// An error of both sides over the same trials; infinite for trials without a usable result.
struct ErrorComparison {
  double base_median = 0.0;
  double variant_median = 0.0;
  double difference = 0.0;      ///< Of the medians, variant - base; 0 if both are infinite.
  Interval interval{0.0, 0.0};  ///< 95 % bootstrap interval of `difference`, over scenes.
  PairedTest test;              ///< Wilcoxon's signed-rank test.
};

/// A variant against the base, over the trials that both have. Errors are from the truth; if
/// there is none, from the pose that the side's own trials of the scene agree on.
struct Comparison {
  std::string variant;
  std::string base;
  std::string sensor;  ///< Empty for all sensors together.
  int pairs = 0;
  int scenes = 0;
  int only_base = 0;     ///< Pairs that the base alone won (no truth: in which it alone agreed).
  int only_variant = 0;  ///< Pairs that the variant alone won.
  ErrorComparison rotation_deg;
  ErrorComparison translation_m;
  PairedTest success;  ///< McNemar's test.
};

/// Every variant against `base`, the first of the experiment, over the trials that both have: by
/// variant, then sensor as in `rows`, then all sensors together. `groups` are the records of
/// `rows`. Without common trials there is no comparison. p values are corrected over the three
/// tests of all variants with the same sensor.
std::vector<Comparison> compare_with_base(const std::string& base, const RecordGroups& groups,
                                          const std::vector<SummaryRow>& rows,
                                          const SuccessBounds& bounds);

}  // namespace croon::experiments
