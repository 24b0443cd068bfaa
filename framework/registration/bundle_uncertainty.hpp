#pragma once

#include "framework/registration/bundle_system.hpp"

namespace croon {

/// The uncertainty of the current state of a bundle adjustment, by sensor, as adjust_bundle
/// documents it: from clusters of planes and from the priors of initial poses, velocities and
/// clocks. Zero for the first sensor and for those that are not free.
struct BundleUncertainty {
  std::vector<PoseCovariance> covariances;
  std::vector<double> clock_offset_stds_s;  ///< Zero unless the offsets are unknowns.
};
BundleUncertainty bundle_uncertainty(const BundleSystem& system, const BundleOptions& options);

/// Classifies each degree of freedom of each sensor by how well the planes of a bundle adjustment
/// constrain it in its current state, with the other sensors fixed; `determined` for the first. The
/// uncertainty of a plane's normal follows from the distribution of its points, and random turns of
/// that size contribute information; in a direction that no surface constrains, all information is
/// this noise, for any number of scenes (see dof_constraints).
std::vector<DofObservability> plane_observability(const BundleSystem& system);

/// The effect of one cluster of observations on the unknowns of a least squares problem.
struct ClusterStep {
  /// The step of the unknowns due to its errors.
  Eigen::VectorXd step;
  /// The variances of `step` if errors are as large as the weights of the observations imply.
  Eigen::VectorXd variances;
};

/// `d = K (1 - K^T H_c K)^-1/2 K^T g_c`, with the gradient g_c and the Hessian H_c of the cluster
/// and a root K of the inverse of the total Hessian, `H^-1 = K K^T`, so that the sum of `d d^T`
/// over all clusters is unbiased if errors are independent (CR2 of Bell and McCaffrey, Survey
/// Methodology 2002). A leverage, an eigenvalue of `K^T H_c K`, is limited to 0.99. Without the
/// inner factor the sum is the sandwich estimator, which is too small where a cluster has high
/// leverage; with its square it is the jackknife, which is too large there.
ClusterStep cluster_step(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                         const Eigen::MatrixXd& K);

/// The covariance of the unknowns: the sum of `d d^T`, with the standard deviation of each unknown
/// widened by student_widening, because few clusters determine it poorly. The degrees of freedom of
/// an unknown are `(sum of v)^2 / (sum of v^2)` over the expected variances v of its clusters
/// (Satterthwaite, Biometrics 1946): the number of clusters if all constrain it equally.
Eigen::MatrixXd covariance_by_clusters(const std::vector<ClusterStep>& clusters);

/// The factor on a standard deviation with n = `freedom` degrees of freedom for which the normal
/// interval of 90 % approximates that of Student's t: `sqrt((n + 1) / (n - 1))`, within 3 % from
/// n = 2 on. The interval of 50 % is then too wide, by 8 % at n = 8, and that of 95 % too narrow,
/// by 4 %. Below 1.5 degrees of freedom, the factor for 1.5 is used.
double student_widening(double freedom);

}  // namespace croon
