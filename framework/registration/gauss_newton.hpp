#pragma once

#include <vector>

#include "framework/geometry/dof.hpp"

namespace croon {

/// A pair of corresponding points at the current pose.
struct Correspondence {
  /// `R s`: the source point turned into the target's axes, m.
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();
  /// `R s + t - p`: from the target point to the source point, in the target's frame, m.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  /// Unit; zero if it is undefined or not needed.
  Eigen::Vector3d target_normal = Eigen::Vector3d::Zero();
  /// `R n`, in the target's axes; zero in the same cases.
  Eigen::Vector3d source_normal = Eigen::Vector3d::Zero();
  float target_variation = 0.0F;  ///< LocalShape::surface_variation.
  double weight = 1.0;            ///< Factor on its residuals, besides the robust kernel's weight.
};

/// The Jacobian of `R s + t` with respect to the six degrees of freedom of `moved`: `[-[R s]x, I]`.
Eigen::Matrix<double, 3, 6> point_jacobian(const Eigen::Vector3d& arm);

/// The Jacobian of `n . (R s + t - p)` with respect to the six degrees of freedom of `moved`:
/// `[(arm x n)^T, n^T]`.
Vector6d plane_jacobian(const Eigen::Vector3d& arm, const Eigen::Vector3d& normal);

/// The information of `R s + t - p` between two surfaces with these normals, `2 e (C_t + R C_s
/// R^T)^-1` with C = diag(e, 1, 1), the normal first (Segal et al. 2009, equation 2; e is
/// `epsilon`). A distance across two parallel planes has the weight one.
Eigen::Matrix3d plane_to_plane_information(const Eigen::Vector3d& target_normal,
                                           const Eigen::Vector3d& source_normal, double epsilon);

/// The sums of one Gauss-Newton step: `information = sum w J^T Omega J`, `gradient = sum w J^T
/// Omega r`. Only the lower triangle of `information` is valid.
struct NormalEquations {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double weighted_square_sum = 0.0;  ///< `sum w r^T Omega r`.
  double weight_sum = 0.0;
  /// Factor on the weight of what is added: `Correspondence::weight` of the current one.
  double factor = 1.0;

  /// Adds the scalar residual `r` with the Jacobian row `J` and the weight `w`.
  void add(const Vector6d& J, double r, double w) {
    w *= factor;
    information.noalias() += J * (w * J).transpose();
    gradient += (w * r) * J;
    weighted_square_sum += w * r * r;
    weight_sum += w;
  }
  /// Adds the residual vector `r` with information `Omega` and the weight `w`.
  void add(const Eigen::Matrix<double, 3, 6>& J, const Eigen::Vector3d& r,
           const Eigen::Matrix3d& Omega, double w);

  /// Both triangles of `information`.
  Matrix6d full_information() const {
    return Matrix6d(information.selfadjointView<Eigen::Lower>());
  }
  /// The step that minimises the linearised cost, `-information^-1 gradient`. The step is zero
  /// along directions that the scene leaves unconstrained (eigenvalues below 1e-9 of the largest).
  Vector6d step() const;
};

}  // namespace croon
