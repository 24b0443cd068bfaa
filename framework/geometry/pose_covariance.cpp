#include "framework/geometry/pose_covariance.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <stdexcept>

#include "framework/geometry/guarded_inverse.hpp"

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
