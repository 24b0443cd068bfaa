#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace croon {

/// The mean of a matrix and its transpose; removes asymmetry due to rounding.
template <int N>
Eigen::Matrix<double, N, N> symmetric(const Eigen::Matrix<double, N, N>& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

/// The inverse of a symmetric matrix with eigenvalues clamped to at least 1e-6 after scaling its
/// diagonal to 1. Independent of the units of the unknowns.
template <int N>
Eigen::Matrix<double, N, N> guarded_inverse(const Eigen::Matrix<double, N, N>& matrix) {
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  const Vector scale = matrix.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric<N>(scaled));
  const Vector values = solver.eigenvalues().cwiseMax(1e-6).cwiseInverse();
  const Matrix inverse =
      solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
  return symmetric<N>(scale.asDiagonal() * inverse * scale.asDiagonal());
}

}  // namespace croon
