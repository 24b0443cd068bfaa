#include "framework/geometry/rigid_transform.hpp"

#include <Eigen/SVD>
#include <cmath>

namespace croon {

Eigen::Matrix3d rotation_from_rpy(const Eigen::Vector3d& rpy_rad) {
  return (Eigen::AngleAxisd(rpy_rad.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy_rad.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy_rad.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d rpy_from_rotation(const Eigen::Matrix3d& R) {
  const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), cos_pitch);
  // At a pitch of +-90 degrees only yaw -+ roll is defined: all of it is assigned to yaw.
  if (cos_pitch < 1e-9) return {0.0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& omega_rad) {
  const double angle = omega_rad.norm();
  if (angle < 1e-300) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, omega_rad / angle).toRotationMatrix();
}

double rotation_angle(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) *= -1.0;
  return U * svd.matrixV().transpose();
}

bool is_rotation_matrix(const Eigen::Matrix3d& matrix) {
  constexpr double kTolerance = 1e-4;
  return (matrix.transpose() * matrix).isIdentity(kTolerance) && matrix.determinant() > 0.0;
}

Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

Points transformed(const Points& cloud, const RigidTransform& T_target_source) {
  Points result;
  result.reserve(cloud.size());
  for (const Eigen::Vector3f& point : cloud) {
    result.push_back((T_target_source * point.cast<double>()).cast<float>());
  }
  return result;
}

Eigen::Quaterniond unit_quaternion(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  for (const double coefficient : {q.w(), q.x(), q.y(), q.z()}) {
    if (coefficient == 0.0) continue;
    return coefficient > 0.0 ? q : Eigen::Quaterniond(-q.coeffs());
  }
  return q;
}

}  // namespace croon
