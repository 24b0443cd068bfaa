#pragma once

#include <string>

#include "framework/base/statistics.hpp"

namespace croon::experiments {

/// What one paired test says; its p values are two-sided.
struct PairedTest {
  bool favours_variant = false;  ///< The side that the sum of the test's scores is on.
  double p = 1.0;                ///< Had every trial been independent.
  double p_holm = 1.0;           ///< The same, corrected for all tests of the sensor (Holm 1979).
  double p_by_scene = 1.0;       ///< With scenes as the units that are independent.
  double p_by_scene_holm = 1.0;
};

/// Whether the difference is significant over trials: corrected p below 0.05.
bool is_significant(const PairedTest& test);

/// Whether it is, and is still with scenes as units.
bool holds_by_scene(const PairedTest& test);

/// An error of both sides over the same trials, those without a usable result as infinite.
struct ErrorComparison {
  double base_median = 0.0;
  double variant_median = 0.0;
  double difference = 0.0;      ///< Of the medians, variant - base; 0 where both are infinite.
  Interval interval{0.0, 0.0};  ///< 95 % bootstrap interval of `difference`, over scenes.
  PairedTest test;              ///< Wilcoxon's signed-rank test.
};

/// A variant against the base, over the trials that both have. Errors are from the truth, where
/// there is none from what the side's own trials of the scene agree on.
struct Comparison {
  std::string variant;
  std::string base;
  std::string sensor;  ///< Empty for all sensors together.
  int pairs = 0;
  int scenes = 0;
  int only_base = 0;     ///< Pairs that the base alone won (no truth: that it alone agreed in).
  int only_variant = 0;  ///< Pairs that the variant alone won.
  ErrorComparison rotation_deg;
  ErrorComparison translation_m;
  PairedTest success;  ///< McNemar's test.
};

}  // namespace croon::experiments
