#pragma once

#include <memory>

#include "framework/params/choice.hpp"
#include "framework/stage/step.hpp"

namespace croon {

/// Which points of the two clouds a step works on.
enum class Points { non_ground, all };

/// The choices of a step's parameter `points`.
inline const params::Words<Points> kPointsWords = {{"non_ground", Points::non_ground},
                                                   {"all", Points::all}};

/// The target and source clouds that a step works on.
struct SelectedClouds {
  std::shared_ptr<const Cloud> target;
  std::shared_ptr<const Cloud> source;
};

/// The clouds with the selected points. Points::non_ground selects all points if no step before has
/// found the ground. Throws StageError if a selected cloud is empty.
SelectedClouds selected_clouds(const Estimate& estimate, Points points);

}  // namespace croon
