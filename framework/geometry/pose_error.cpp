#include "framework/geometry/pose_error.hpp"

namespace croon {

PoseError pose_error(const RigidTransform& estimate, const RigidTransform& truth) {
  const Eigen::Matrix3d R = estimate.rotation * truth.rotation.transpose();
  PoseError error;
  error.dof << rpy_from_rotation(R), estimate.translation - truth.translation;
  error.rotation_rad = rotation_angle(R);
  error.translation_m = error.dof.tail<3>().norm();
  return error;
}

}  // namespace croon
