#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/stage/step.hpp"

namespace croon {

/// The choices of a step's parameter `points`.
inline const std::vector<std::string> kPointChoices = {"non_ground", "all"};

/// The target and source clouds that a step works on.
struct SelectedClouds {
  std::shared_ptr<const Cloud> target;
  std::shared_ptr<const Cloud> source;
};

/// "all", or "non_ground": the points off the ground where a step before has found it, else all.
/// Throws StageError where a selected cloud is empty.
SelectedClouds selected_clouds(const Estimate& estimate, const std::string& points);

}  // namespace croon
