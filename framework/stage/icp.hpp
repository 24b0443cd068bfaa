#pragma once

#include "framework/geometry/dof.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// What a registration found.
struct Registration {
  RigidTransform T_target_source;
  double rmse_m = 0.0;       ///< Root mean square of the distances that were minimised, inliers only.
  double inlier_ratio = 0.0; ///< Correspondences over source points.
  int correspondences = 0;
  int iterations = 0;
  bool converged = false;
  /// Gauss-Newton's `sum of w J^T J` at the solution, over the degrees of freedom of Dof (`moved`): per m^2
  /// for metres, per rad^2 for radians, for residuals in metres of unit variance. Its small eigenvalues are
  /// the directions that the scene leaves open.
  Matrix6d information = Matrix6d::Zero();
};

/// Registers a source cloud to a target cloud from a start (paper, section III-B).
class Icp {
 public:
  using Kind = Icp;
  static constexpr const char* kKind = "icp";
  virtual ~Icp() = default;

  /// The pose of the source near `start`. Throws StageError where there are too few correspondences.
  virtual Registration align(const Cloud& target, const Cloud& source,
                             const RigidTransform& start) const = 0;
};

}  // namespace croon
