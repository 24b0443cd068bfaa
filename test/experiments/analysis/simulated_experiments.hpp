#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "experiments/analysis/paired_tests.hpp"
#include "framework/base/rng.hpp"

namespace croon::test {

/// An experiment with two variants that is made up.
struct MadeUp {
  std::size_t scenes = 30;
  std::size_t trials = 1;         ///< Of each scene.
  double effect = 0.0;            ///< That the variant's errors are larger by.
  double scene_effect = 0.0;      ///< The std of what a scene adds to the variant's errors.
  double failure_ratio = 0.0;     ///< Of both sides, independently.
  double variant_failures = 0.0;  ///< More of the variant's.
  double grain = 0.0;             ///< Errors are multiples of it: ties; 0 for none.
};

struct DrawnExperiment {
  experiments::Pairs pairs;
  std::vector<std::size_t> scenes;
  std::vector<double> success;  ///< 1 if the variant alone won, -1 if the base did, else 0.
  int only_base = 0;
  int only_variant = 0;
};

DrawnExperiment draw_experiment(Rng& rng, const MadeUp& like);

inline constexpr int kRuns = 2000;

/// The share of `kRuns` drawn experiments whose `p` is below 0.05.
double share_significant(const MadeUp& like,
                         const std::function<double(const DrawnExperiment&)>& p);

/// 5 % and three standard deviations of a binomial share of `kRuns`: a test that keeps its level
/// is above in one of 740 checks, and always or never, for the draws are fixed.
inline constexpr double kMaxFalsePositives = 0.05 + 3.0 * 0.00487;

}  // namespace croon::test
