#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/run/trial_plan.hpp"

namespace croon::experiments {

/// How often a step runs.
struct StepCount {
  std::string step;       ///< Its name.
  std::size_t alone = 0;  ///< Where each variant runs by itself.
  std::size_t runs = 0;   ///< Where variants share the steps in which they begin alike.
};

/// What `plan` comes to, by the steps as variants first name them, where no step fails.
std::vector<StepCount> count_steps(const Experiment& experiment, const Plan& plan);

}  // namespace croon::experiments
