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

/// What the errors of a cluster of observations move the unknowns of a least squares by, so that
/// the sum of `d d^T` over all clusters has no bias if errors are independent: `d = K (1 - K^T H_c
/// K)^-1/2 K^T g_c`, with the gradient g_c and the Hessian H_c of the cluster and a root K of the
/// inverse of the Hessian of all, `H^-1 = K K^T` (CR2 of Bell and McCaffrey, Survey Methodology
/// 2002). A leverage, an eigenvalue of `K^T H_c K`, counts as at most 0.99. Without the inner
/// factor the sum is the sandwich, which is too small where a cluster has much leverage; with its
/// square it is the jackknife, which is too large there.
Eigen::VectorXd cluster_step(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                             const Eigen::MatrixXd& K);

}  // namespace croon
