#pragma once

#include <vector>

#include "framework/registration/plane_cost.hpp"

namespace croon {

/// The robust cost of the `patches` of one scene and its derivatives with respect to the poses of
/// all sensors, 6 for each, and then to the velocity, if `state` has one: the sum of
/// `w^2 c / (w^2 + c)` over the costs c of the planes, with the width w of the kernel.
struct BundleCost {
  double value = 0.0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
};
BundleCost bundle_cost(const std::vector<PlanePatch>& patches, const RigState& state,
                       double kernel_width);

/// Only the value of bundle_cost.
double bundle_value(const std::vector<PlanePatch>& patches, const RigState& state,
                    double kernel_width);

}  // namespace croon
