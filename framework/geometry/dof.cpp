#include "framework/geometry/dof.hpp"

namespace croon {

RigidTransform moved(const RigidTransform& T_target_source, const Vector6d& offset) {
  return {rotation_from_rpy(offset.head<3>()) * T_target_source.rotation,
          T_target_source.translation + offset.tail<3>()};
}

RigidTransform stepped(const RigidTransform& T_target_source, const Vector6d& step) {
  const double angle = step.head<3>().norm();
  const double share = angle > 0.5 ? 0.5 / angle : 1.0;
  return {nearest_rotation(rotation_exp(share * step.head<3>()) * T_target_source.rotation),
          T_target_source.translation + share * step.tail<3>()};
}

PoseError pose_error(const RigidTransform& estimate, const RigidTransform& truth) {
  const Eigen::Matrix3d R = estimate.rotation * truth.rotation.transpose();
  PoseError error;
  error.dof << rpy_from_rotation(R), estimate.translation - truth.translation;
  error.rotation_rad = rotation_angle(R);
  error.translation_m = error.dof.tail<3>().norm();
  return error;
}

}  // namespace croon
