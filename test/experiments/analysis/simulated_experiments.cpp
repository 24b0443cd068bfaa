#include "test/experiments/analysis/simulated_experiments.hpp"

#include <cmath>
#include <limits>

#include "test/support/random_geometry.hpp"

namespace croon::test {

DrawnExperiment draw_experiment(Rng& rng, const MadeUp& like) {
  constexpr double kFailed = std::numeric_limits<double>::infinity();
  DrawnExperiment drawn;
  const auto error = [&](double offset, double failure_ratio) {
    const double value = rng.normal() + offset;
    return rng.uniform() < failure_ratio ? kFailed : value;
  };
  const auto grained = [&](double value) {
    return like.grain > 0.0 ? std::round(value / like.grain) * like.grain : value;
  };
  for (std::size_t scene = 0; scene < like.scenes; ++scene) {
    const double shift = like.effect + like.scene_effect * rng.normal();
    for (std::size_t trial = 0; trial < like.trials; ++trial) {
      const double base = error(0.0, like.failure_ratio);
      const double variant = error(shift, like.failure_ratio + like.variant_failures);
      // Half of the finished trials are good: success has the shift of its scene too.
      const int won = static_cast<int>(variant < 0.0) - static_cast<int>(base < 0.0);
      drawn.pairs.base.push_back(grained(base));
      drawn.pairs.variant.push_back(grained(variant));
      drawn.scenes.push_back(scene);
      drawn.success.push_back(won);
      drawn.only_base += won < 0;
      drawn.only_variant += won > 0;
    }
  }
  return drawn;
}

double share_significant(const MadeUp& like,
                         const std::function<double(const DrawnExperiment&)>& p) {
  Rng rng = croon::test::test_rng();
  int count = 0;
  for (int run = 0; run < kRuns; ++run) count += p(draw_experiment(rng, like)) < 0.05;
  return static_cast<double>(count) / kRuns;
}

}  // namespace croon::test
