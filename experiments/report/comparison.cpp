#include "experiments/report/comparison.hpp"

namespace croon::experiments {

namespace {

constexpr double kLevel = 0.05;

}  // namespace

bool is_significant(const PairedTest& test) { return test.p_holm < kLevel; }

bool holds_by_scene(const PairedTest& test) {
  return is_significant(test) && test.p_by_scene_holm < kLevel;
}

}  // namespace croon::experiments
