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

void NormalEquations::add(const Eigen::Matrix<double, 3, 6>& J, const Eigen::Vector3d& r,
                          const Eigen::Matrix3d& Omega, double w) {
  w *= factor;
  const Eigen::Matrix<double, 3, 6> weighted = w * (Omega * J);
  information.triangularView<Eigen::Lower>() += J.transpose() * weighted;
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
