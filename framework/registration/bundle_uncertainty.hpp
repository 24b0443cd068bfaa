#pragma once

#include "framework/registration/bundle_system.hpp"

namespace croon {

/// What is not known of the present state of a bundle adjustment, by sensor, as adjust_bundle
/// documents it: that by clusters of planes, and what starts, velocities and clocks are
/// not known by. Zero for the first sensor and for those that are not free.
struct BundleUncertainty {
  std::vector<PoseCovariance> covariances;
  std::vector<double> clock_offset_stds_s;  ///< Zero unless the offsets are unknowns.
};
BundleUncertainty bundle_uncertainty(const BundleSystem& system, const BundleOptions& options);

/// What one cluster of observations does to the unknowns of a least squares.
struct ClusterStep {
  /// What its errors move the unknowns by.
  Eigen::VectorXd step;
  /// The variances of `step` if errors are as large as the weights of the observations say.
  Eigen::VectorXd variances;
};

/// `d = K (1 - K^T H_c K)^-1/2 K^T g_c`, so that the sum of `d d^T` over all clusters has no bias
/// if errors are independent, with the gradient g_c and the Hessian H_c of the cluster and a root K
/// of the inverse of the Hessian of all, `H^-1 = K K^T` (CR2 of Bell and McCaffrey, Survey
/// Methodology 2002). A leverage, an eigenvalue of `K^T H_c K`, counts as at most 0.99. Without the
/// inner factor the sum is the sandwich, which is too small where a cluster has much leverage; with
/// its square it is the jackknife, which is too large there.
ClusterStep cluster_step(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                         const Eigen::MatrixXd& K);

/// The covariance of the unknowns: the sum of `d d^T`, with the standard deviation of each unknown
/// widened by student_widening, because few clusters do not know it well. The degrees of freedom
/// of an unknown are `(sum of v)^2 / (sum of v^2)` over the variances v that its clusters are
/// expected to have (Satterthwaite, Biometrics 1946): as many as clusters if all hold it alike.
Eigen::MatrixXd covariance_by_clusters(const std::vector<ClusterStep>& clusters);

/// By what a standard deviation that is known with so many degrees of freedom n is multiplied, so
/// that the normal interval of 90 % is that of Student's t: `sqrt((n + 1) / (n - 1))`, which is
/// that within 3 % from n = 2 on. That of 50 % is then too wide, by 8 % at n = 8, and that of 95 %
/// too narrow, by 4 %. Below 1.5 degrees of freedom it is as at 1.5.
double student_widening(double freedom);

}  // namespace croon
