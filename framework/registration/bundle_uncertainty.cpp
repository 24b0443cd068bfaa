#include "framework/registration/bundle_uncertainty.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "framework/base/threads.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/registration/gauss_newton.hpp"
#include "framework/registration/observability.hpp"
#include "framework/registration/surface_key.hpp"

namespace croon {
namespace {

/// The planes of one scene by direction and position: the errors in a cluster are not independent.
std::vector<std::vector<PlanePatch>> clusters_of(const std::vector<PlanePatch>& planes,
                                                 const RigState& state) {
  constexpr double kCell_m = 3.0;
  std::map<SurfaceKey, std::vector<PlanePatch>> clusters;
  PlaneCost cost;
  for (const PlanePatch& plane : planes) {
    plane_cost(plane, state, cost);
    clusters[surface_key(cost.centre, cost.normal, kCell_m)].push_back(plane);
  }
  std::vector<std::vector<PlanePatch>> result;
  for (auto& [surface, cluster] : clusters) result.push_back(std::move(cluster));
  return result;
}

/// The gradient and Hessian of `cost` along the motion in which the velocity follows the poses.
BlockSystem along(const BlockSystem& cost, const ReducedCost& scene) {
  if (scene.by_pose.size() == 0) return cost;
  const Eigen::Index size = cost.gradient.size() - 6;
  Eigen::MatrixXd follow(size + 6, size);
  follow << Eigen::MatrixXd::Identity(size, size), scene.by_pose;
  return {follow.transpose() * cost.gradient, follow.transpose() * cost.hessian * follow};
}

/// The steps of each cluster of planes of a scene.
std::vector<ClusterStep> steps_by_cluster(const BundleSystem& system, std::size_t scene,
                                          const ReducedCost& scene_cost, const Eigen::MatrixXd& K) {
  const auto clusters =
      clusters_of(system.planes()[scene], system.rig_state(system.state(), scene));
  std::vector<ClusterStep> steps(clusters.size());
  for_each_in_parallel(clusters.size(), [&](std::size_t c) {
    const BlockSystem own = along(system.scene_cost(scene, clusters[c], false), scene_cost);
    steps[c] = cluster_step(own.gradient, own.hessian, K);
  });
  return steps;
}

/// The step of all poses if a scene's velocity has a constant error along its own direction, of
/// `error_mps` but at most the magnitude of the velocity; zero if the scene's velocity is not an
/// unknown. `hessian` is that of the poses, with all velocities following; `cost` and
/// `reduced_cost` are those of the scene.
Eigen::VectorXd step_for_velocity_error(const Twist& velocity, const BlockSystem& cost,
                                        const ReducedCost& reduced_cost,
                                        const Eigen::MatrixXd& hessian, double error_mps) {
  const Eigen::Index size = hessian.rows();
  const bool is_moving = velocity.linear_mps.norm() > 0.0 && reduced_cost.by_pose.size() > 0;
  if (!is_moving) return Eigen::VectorXd::Zero(size);
  const Eigen::MatrixXd with_fixed_velocity =
      hessian - reduced_cost.hessian + cost.hessian.topLeftCorner(size, size);
  return -guarded_inverse<Eigen::Dynamic>(with_fixed_velocity) *
         cost.hessian.block(0, cost.hessian.cols() - 3, size, 3) *
         (std::min(error_mps, velocity.linear_mps.norm()) * velocity.linear_mps.normalized());
}

Observability observability_for(double std_ratio) {
  constexpr double kWeak = 0.1, kUnobservable = 0.5;
  if (std_ratio > kUnobservable) return Observability::unobservable;
  return std_ratio > kWeak ? Observability::weak : Observability::determined;
}

/// The observability of a pose's degrees of freedom from its standard deviations.
DofObservability observability_from(const Matrix6d& covariance, const Vector6d& prior_std) {
  return judged_dofs(covariance, guarded_inverse<6>(covariance),
                     [&](std::size_t dof, const Matrix6d& of_free) {
                       const auto i = static_cast<Eigen::Index>(dof);
                       return observability_for(std::sqrt(of_free(i, i)) / prior_std(i));
                     });
}

/// The costs of all scenes, and their sum with the velocities following the poses.
struct AllScenes {
  std::vector<BlockSystem> costs;    ///< By scene.
  std::vector<ReducedCost> reduced;  ///< The same without the velocity.
  Eigen::MatrixXd hessian;
  /// The covariance of the gradient that is due to the priors of initial poses and velocities.
  Eigen::MatrixXd scatter;
};

AllScenes all_scenes(const BundleSystem& system) {
  AllScenes all;
  all.hessian = system.start_cost().hessian;
  all.scatter = system.start_scatter();
  for (std::size_t s = 0; s < system.planes().size(); ++s) {
    const bool has_velocity = system.state().velocities[s].has_value();
    all.costs.push_back(system.scene_cost(s, system.planes()[s], true));
    all.reduced.push_back(reduced(all.costs.back(), has_velocity));
    all.hessian += all.reduced.back().hessian;
    if (!has_velocity) continue;
    const Eigen::MatrixXd& by_pose = all.reduced.back().by_pose;
    all.scatter += by_pose.transpose() * system.velocity_scatter(s) * by_pose;
  }
  return all;
}

/// The covariance of all poses, optionally followed by the clock offsets.
Eigen::MatrixXd joint_covariance(const BundleSystem& system, const BundleOptions& options) {
  const AllScenes all = all_scenes(system);
  const Eigen::MatrixXd inverse = guarded_inverse<Eigen::Dynamic>(all.hessian);
  const Eigen::MatrixXd K = Eigen::LLT<Eigen::MatrixXd>(inverse).matrixL();
  Eigen::MatrixXd by_velocity = Eigen::MatrixXd::Zero(inverse.rows(), inverse.cols());
  std::vector<ClusterStep> clusters;
  for (std::size_t s = 0; s < all.costs.size(); ++s) {
    std::vector<ClusterStep> own = steps_by_cluster(system, s, all.reduced[s], K);
    std::move(own.begin(), own.end(), std::back_inserter(clusters));
    const Eigen::VectorXd step =
        step_for_velocity_error(system.known_velocity(s), all.costs[s], all.reduced[s], all.hessian,
                                options.velocity_error_std_mps);
    by_velocity += step * step.transpose();
  }
  Eigen::MatrixXd by_clusters = Eigen::MatrixXd::Zero(inverse.rows(), inverse.cols());
  if (!clusters.empty()) by_clusters = covariance_by_clusters(clusters);
  return options.std_scale * options.std_scale * by_clusters + by_velocity +
         inverse * all.scatter * inverse;
}

/// The information of planes about the pose of a sensor, and the part due to noisy normals.
struct PlaneEvidence {
  Matrix6d information = Matrix6d::Zero();
  Matrix6d noise = Matrix6d::Zero();
};

/// Adds the information of a patch about each of its sensors, with the others fixed.
void add_patch(const PlanePatch& patch, const std::vector<RigidTransform>& poses,
               std::vector<PlaneEvidence>& evidence) {
  PointSums all;
  for (const PlanePatch::View& view : patch.views) {
    all.add(moved(view.sums, poses[view.sensor]));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(all.scatter());
  const Eigen::Vector3d& across = solver.eigenvalues();
  for (const PlanePatch::View& view : patch.views) {
    const double own = view.sums.weight, others = all.weight - own;
    if (!(own > 0.0) || !(others > 0.0)) continue;
    // The variance of the distance between two planes is the sum of their variances.
    const double weight = own * others / all.weight;
    const Eigen::Vector3d arm = poses[view.sensor].rotation * (view.sums.sum / own);
    const Vector6d J = plane_jacobian(arm, solver.eigenvectors().col(0));
    PlaneEvidence& of_sensor = evidence[view.sensor];
    of_sensor.information += weight * (J * J.transpose());
    for (int k = 1; k < 3; ++k) {
      // The weights are inverse variances, so this is the variance of a turn towards the axis k.
      const double turn = 1.0 / std::max(across(k) - across(0), 1e-12);
      const Vector6d turned = plane_jacobian(arm, solver.eigenvectors().col(k));
      of_sensor.noise += weight * turn * (turned * turned.transpose());
    }
  }
}

}  // namespace

ClusterStep cluster_step(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                         const Eigen::MatrixXd& K) {
  // A cluster that alone constrains a direction has a leverage of one and no finite step there.
  constexpr double kMaxLeverage = 0.99;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_leverage(K.transpose() * hessian * K);
  const Eigen::VectorXd leverage = of_leverage.eigenvalues().cwiseMax(0.0);
  const Eigen::MatrixXd directions = K * of_leverage.eigenvectors();
  const Eigen::VectorXd rest = (1.0 - leverage.array().min(kMaxLeverage)).sqrt();
  const Eigen::VectorXd slope = directions.transpose() * gradient;
  return {directions * slope.cwiseQuotient(rest), directions.cwiseAbs2() * leverage};
}

Eigen::MatrixXd covariance_by_clusters(const std::vector<ClusterStep>& clusters) {
  const Eigen::Index size = clusters.front().step.size();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(size), sum_of_squares = sum;
  for (const ClusterStep& cluster : clusters) {
    covariance += cluster.step * cluster.step.transpose();
    sum += cluster.variances;
    sum_of_squares += cluster.variances.cwiseAbs2();
  }
  Eigen::VectorXd widening(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const bool is_constrained = sum_of_squares(i) > 0.0;
    widening(i) = is_constrained ? student_widening(sum(i) * sum(i) / sum_of_squares(i)) : 1.0;
  }
  return widening.asDiagonal() * covariance * widening.asDiagonal();
}

double student_widening(double freedom) {
  constexpr double kMinFreedom = 1.5;
  const double n = std::max(freedom, kMinFreedom);
  return std::sqrt((n + 1.0) / (n - 1.0));
}

BundleUncertainty bundle_uncertainty(const BundleSystem& system, const BundleOptions& options) {
  BundleUncertainty result;
  result.covariances.resize(system.state().poses.size());
  result.clock_offset_stds_s.assign(system.state().poses.size(), 0.0);
  if (system.free_sensors().empty()) return result;
  const Eigen::MatrixXd covariance = joint_covariance(system, options);
  for (const std::size_t k : system.free_sensors()) {
    const Eigen::Index at = system.pose_block(k).at;
    PoseCovariance& own = result.covariances[k];
    own.matrix = bounded_covariance(covariance.block<6, 6>(at, at));
    own.dofs = observability_from(own.matrix, system.prior_std());
    const Block& clock = system.clock_block(k);
    if (clock) result.clock_offset_stds_s[k] = std::sqrt(covariance(clock.at, clock.at));
  }
  return result;
}

std::vector<DofObservability> plane_observability(const BundleSystem& system) {
  const std::size_t sensors = system.state().poses.size();
  std::vector<PlaneEvidence> evidence(sensors);
  for (std::size_t s = 0; s < system.planes().size(); ++s) {
    const std::vector<RigidTransform> poses = system.rig_state(system.state(), s).poses;
    for (const PlanePatch& patch : system.planes()[s]) add_patch(patch, poses, evidence);
  }
  const Matrix6d prior = unknown_variances().cwiseInverse().asDiagonal();
  std::vector<DofObservability> words(sensors);  // Initially all determined.
  for (std::size_t k = 1; k < sensors; ++k) {
    const auto held = dof_constraints(evidence[k].information, evidence[k].noise, prior);
    for (std::size_t dof = 0; dof < held.size(); ++dof) words[k][dof] = held[dof].word;
  }
  return words;
}

}  // namespace croon
