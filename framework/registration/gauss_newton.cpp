#include "framework/registration/gauss_newton.hpp"

#include <Eigen/Eigenvalues>

namespace croon {

Eigen::Matrix<double, 3, 6> point_jacobian(const Eigen::Vector3d& arm) {
  Eigen::Matrix<double, 3, 6> J;
  J << 0, arm.z(), -arm.y(), 1, 0, 0,  //
      -arm.z(), 0, arm.x(), 0, 1, 0,   //
      arm.y(), -arm.x(), 0, 0, 0, 1;
  return J;
}

Vector6d plane_jacobian(const Eigen::Vector3d& arm, const Eigen::Vector3d& normal) {
  Vector6d J;
  J << arm.cross(normal), normal;
  return J;
}

Eigen::Matrix3d plane_to_plane_information(const Eigen::Vector3d& target_normal,
                                           const Eigen::Vector3d& source_normal, double epsilon) {
  // diag(e, 1, 1) in the axes of a surface with the normal n is 1 - (1 - e) n n^T.
  const auto covariance = [epsilon](const Eigen::Vector3d& n) -> Eigen::Matrix3d {
    return Eigen::Matrix3d::Identity() - (1.0 - epsilon) * (n * n.transpose());
  };
  const Eigen::Matrix3d sum = covariance(target_normal) + covariance(source_normal);
  return 2.0 * epsilon * sum.inverse();
}

void NormalEquations::add(const Eigen::Matrix<double, 3, 6>& J, const Eigen::Vector3d& r,
                          const Eigen::Matrix3d& Omega, double w) {
  w *= factor;
  const Eigen::Matrix<double, 3, 6> weighted = w * (Omega * J);
  // All of it at once, unrolled: a product of one triangle is a call for matrices of any size.
  information.noalias() += J.transpose().lazyProduct(weighted);
  gradient.noalias() += weighted.transpose() * r;
  weighted_square_sum += w * r.dot(Omega * r);
  weight_sum += w;
}

Vector6d NormalEquations::step() const {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(full_information());
  const Vector6d& values = solver.eigenvalues();
  Vector6d step = Vector6d::Zero();
  for (int i = 0; i < 6; ++i) {
    if (!(values(i) > 1e-9 * values(5))) continue;
    const Vector6d direction = solver.eigenvectors().col(i);
    step -= (direction.dot(gradient) / values(i)) * direction;
  }
  return step;
}

}  // namespace croon
