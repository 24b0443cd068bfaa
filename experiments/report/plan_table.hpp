#pragma once

#include <string>
#include <vector>

#include "experiments/run/pipeline_tree.hpp"

namespace croon::experiments {

/// What a run has before it.
struct PlanFigures {
  std::size_t starts = 0;  ///< Of all scenes and sensors.
  std::size_t trials = 0;  ///< Starts, each with its variants.
  std::size_t done = 0;    ///< Trials that the store has.
  std::vector<StepCount> steps;
};

/// How often each step is to run, and how often variants share it, for `croon run --plan`.
std::string plan_table(const PlanFigures& plan, bool colours);

}  // namespace croon::experiments
