#pragma once

#include <vector>

#include "framework/registration/block_system.hpp"
#include "framework/registration/plane_cost.hpp"

namespace croon {

/// The robust cost of the `patches` of one scene: the sum of `w^2 c / (w^2 + c)` over the costs c
/// of the planes, with the width w of the kernel.
double bundle_value(const std::vector<PlanePatch>& patches, const RigState& state,
                    double kernel_width);

/// The derivatives of bundle_value with respect to the `poses`, by sensor, and then to the
/// velocity, if `state` has one.
BlockSystem bundle_cost(const std::vector<PlanePatch>& patches, const RigState& state,
                        double kernel_width, const std::vector<Block>& poses);

}  // namespace croon
