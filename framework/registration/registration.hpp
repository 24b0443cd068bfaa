#pragma once

#include "framework/geometry/dof.hpp"

namespace croon {

/// The result of a registration.
struct Registration {
  RigidTransform T_target_source;
  double rmse_m = 0.0;  ///< Root of the weighted mean of the squared residuals that were minimised.
  double inlier_ratio = 0.0;  ///< Correspondences over the source points used.
  int correspondences = 0;
  int iterations = 0;
  bool converged = false;
  /// The Gauss-Newton matrix `sum of w J^T J` at the solution, over the degrees of freedom of Dof
  /// (`moved`): per m^2 for metres, per rad^2 for radians, for residuals in metres of unit
  /// variance. The eigenvectors of its small eigenvalues are unconstrained directions.
  Matrix6d information = Matrix6d::Zero();
};

}  // namespace croon
