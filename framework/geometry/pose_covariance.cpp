#include "framework/geometry/pose_covariance.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/geometry/guarded_inverse.hpp"
#include "framework/geometry/twist.hpp"

namespace croon {
namespace {

/// The sum times `factor`, with the worst observability of each degree of freedom.
PoseCovariance scaled_sum(const std::vector<PoseCovariance>& covariances, double factor) {
  if (covariances.empty()) throw std::logic_error("no covariances");
  PoseCovariance sum;
  for (const PoseCovariance& one : covariances) {
    sum.matrix += one.matrix;
    sum.dofs = worst_observability(sum.dofs, one.dofs);
  }
  sum.matrix *= factor;
  return sum;
}

}  // namespace

std::optional<Observability> observability_of(const std::string& name) {
  for (const Observability word : kObservabilities) {
    if (name == name_of(word)) return word;
  }
  return std::nullopt;
}

DofObservability best_observability(const DofObservability& a, const DofObservability& b) {
  DofObservability words;
  for (std::size_t dof = 0; dof < words.size(); ++dof) words[dof] = std::min(a[dof], b[dof]);
  return words;
}

DofObservability worst_observability(const DofObservability& a, const DofObservability& b) {
  DofObservability words;
  for (std::size_t dof = 0; dof < words.size(); ++dof) words[dof] = std::max(a[dof], b[dof]);
  return words;
}

PoseCovariance composed_covariance(const RigidTransform& T_a_b, const PoseCovariance& of_a_b,
                                   const RigidTransform& T_b_c, const PoseCovariance& of_b_c) {
  const Eigen::Matrix3d& R = T_a_b.rotation;
  Matrix6d by_first = Matrix6d::Identity();
  by_first.bottomLeftCorner<3, 3>() = -cross_matrix(R * T_b_c.translation);
  Matrix6d by_second = Matrix6d::Zero();
  by_second.topLeftCorner<3, 3>() = R;
  by_second.bottomRightCorner<3, 3>() = R;
  const Matrix6d sum = by_first * of_a_b.matrix * by_first.transpose() +
                       by_second * of_b_c.matrix * by_second.transpose();
  PoseCovariance composed{0.5 * (sum + sum.transpose()), of_a_b.dofs};
  // An axis that contributes less than this to an axis of the frame a does not count.
  constexpr double kMinCosine = 0.1;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Eigen::Index block = i < 3 ? 0 : 3;
    for (Eigen::Index j = block; j < block + 3; ++j) {
      if (std::abs(R(i - block, j - block)) < kMinCosine) continue;
      Observability& word = composed.dofs.at(static_cast<std::size_t>(i));
      word = std::max(word, of_b_c.dofs.at(static_cast<std::size_t>(j)));
    }
  }
  return composed;
}

bool is_covariance(const Matrix6d& matrix) {
  if (!matrix.allFinite() || matrix != matrix.transpose()) return false;
  const Vector6d variances = matrix.diagonal();
  if (variances.minCoeff() < 0.0 || variances.maxCoeff() > kMaxVariance) return false;
  // Rotations and translations have different units, so the correlations are examined.
  Matrix6d correlations;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double scale = std::sqrt(variances(i)) * std::sqrt(variances(j));
      if (!(scale > 0.0) && matrix(i, j) != 0.0) return false;
      correlations(i, j) = scale > 0.0 ? matrix(i, j) / scale : 0.0;
    }
  }
  if (!(correlations.cwiseAbs().maxCoeff() <= 1.0 + 1e-9)) return false;
  constexpr double kRounding = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(correlations, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0) >= -kRounding;
}

Vector6d unknown_variances() {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(kUnknown_rad * kUnknown_rad),
      Eigen::Vector3d::Constant(kUnknown_m * kUnknown_m);
  return variances;
}

Matrix6d bounded_covariance(const Matrix6d& covariance) {
  constexpr double kRounding = 1e-13;  // Of the largest eigenvalue.
  const Vector6d root = unknown_variances().cwiseSqrt();
  const Vector6d inverse_root = root.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(
      symmetric<6>(inverse_root.asDiagonal() * covariance * inverse_root.asDiagonal()));
  Vector6d values =
      solver.eigenvalues().cwiseMax(kRounding * solver.eigenvalues()(5)).cwiseMax(0.0);
  for (int i = 0; i < 6; ++i) values(i) /= 1.0 + values(i);
  const Matrix6d inside =
      solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
  return symmetric<6>(root.asDiagonal() * inside * root.asDiagonal());
}

PoseCovariance covariance_of_mean(const std::vector<PoseCovariance>& covariances) {
  const auto count = static_cast<double>(covariances.size());
  return scaled_sum(covariances, 1.0 / (count * count));
}

PoseCovariance mean_covariance(const std::vector<PoseCovariance>& covariances) {
  return scaled_sum(covariances, 1.0 / static_cast<double>(covariances.size()));
}

}  // namespace croon
