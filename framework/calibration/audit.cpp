#include "framework/calibration/audit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/threads.hpp"
#include "framework/geometry/pose_covariance.hpp"
#include "framework/registration/block_system.hpp"
#include "framework/registration/joint_pair.hpp"
#include "framework/registration/joint_registration.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/spatial/evenly_spaced.hpp"

namespace croon {
namespace {

/// Points of the sensor's own mounting and of the car around it.
constexpr double kMinAuditRange_m = 1.0;

/// Maximum number of points of a cloud: their normals are about those of all points.
constexpr std::size_t kMaxCloudPoints = 40000;

/// Minimum share of the points of a sensor with a correspondence, and the maximum standard
/// deviations with which a scan counts.
constexpr double kMinOverlap = 0.1;

/// Possible times between two scans from which a velocity is computed.
constexpr double kMinInterval_s = 0.02, kMaxInterval_s = 0.5;

/// Standard deviations of the velocity during a scan about that between two scans.
constexpr double kAccelerated_mps = 0.05, kAccelerated_radps = 0.01;

JointOptions audit_options() {
  JointOptions options;
  options.points = 3000;
  options.max_iterations = 8;
  return options;
}

ThinnedScan thinned_scan(const PointCloud& cloud, bool uses_times) {
  ThinnedScan thinned;
  thinned.has_times = uses_times && find_channel(cloud, kTime) != nullptr;
  const std::vector<double> times = thinned.has_times ? times_s(cloud) : std::vector<double>();
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.points[i].squaredNorm() >= static_cast<float>(kMinAuditRange_m * kMinAuditRange_m)) {
      kept.push_back(i);
    }
  }
  const std::size_t count = std::min(kept.size(), kMaxCloudPoints);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = kept[evenly_spaced_index(n, kept.size(), count)];
    thinned.points.push_back(cloud.points[i]);
    thinned.times_s.push_back(thinned.has_times ? times[i] : 0.0);
  }
  return thinned;
}

/// Why the points of a sensor cannot be moved to the time of the reference; empty if they can.
std::string why_not_with(const ThinnedScan& scan, double reference_s) {
  constexpr double kMaxApart_s = 0.5;
  if (!scan.has_times) return "its points have no times, unlike those of the reference";
  const bool is_near = std::abs(span_of(scan.times_s).middle_s() - reference_s) <= kMaxApart_s;
  return is_near ? "" : "its clock differs from that of the reference";
}

/// The scan with the distortion by `velocity`, in the sensor's frame, removed.
TimedScan timed_scan(ThinnedScan scan, const Twist& velocity, double reference_s,
                     const std::string& name) {
  if (!scan.has_times) {
    std::fill(scan.times_s.begin(), scan.times_s.end(), reference_s);
  } else if (!vector_of(velocity).isZero(0.0)) {
    scan.points = deskewed(scan.points, scan.times_s, velocity, reference_s);
  }
  return {std::make_shared<const Cloud>(PointCloud(std::move(scan.points)),
                                        StreamKey(0).with("audit").with(name)),
          std::move(scan.times_s)};
}

/// Computes the normals that the registration will need of a source; in parallel for all scans.
void find_normals(const Cloud& cloud, const JointOptions& options) {
  const Normals& normals = cloud.normals(options.normal_neighbours);
  const std::size_t size = cloud.points().size();
  const std::size_t count = std::min(size, static_cast<std::size_t>(options.points));
  for (std::size_t n = 0; n < count; ++n) {
    normals.at(static_cast<int>(evenly_spaced_index(n, size, count)));
  }
}

/// The joint cost of one scene around its solution, by cube of space.
class JackknifeSystem {
 public:
  JackknifeSystem(const JointScene& scene, const JointState& state, const JointOptions& options) {
    for (std::size_t j = 0; j < scene.sources.size(); ++j) {
      poses_.push_back(appended_block(6, unknowns_));
    }
    velocity_ = appended_block(scene.is_moving ? 6 : 0, unknowns_);
    all_ = BlockSystem::zero(unknowns_);
    const DeskewedTarget target(scene, state.velocities.front(), options);
    const JointView view = last_view(state, target.velocity(), options);
    counts_.assign(scene.sources.size(), 0);
    std::vector<std::map<JointCell, CellEquations>> by_source(scene.sources.size());
    for_each_in_parallel(by_source.size(), [&](std::size_t j) {
      by_source[j] = cell_equations(scene.sources[j], target, view);
    });
    for (std::size_t j = 0; j < scene.sources.size(); ++j) {
      for (const auto& [cell, sums] : by_source[j]) {
        BlockSystem& system = cells_.try_emplace(cell, BlockSystem::zero(unknowns_)).first->second;
        add(j, sums, system);
        add(j, sums, all_);
        counts_[j] += sums.correspondences;
      }
    }
    if (velocity_) {
      prior_ = velocity_information(scene, options);
      all_.add(velocity_, velocity_, prior_);
    }
  }

  int correspondences(std::size_t source) const { return counts_[source]; }

  /// The covariance of all unknowns; residuals of single points have the variance `point_m2`.
  Eigen::MatrixXd covariance(double point_m2) const {
    const Eigen::MatrixXd inverse =
        damped(all_.hessian).solve(Eigen::MatrixXd::Identity(unknowns_, unknowns_));
    Eigen::MatrixXd sum = point_m2 * inverse;
    for (const auto& [cell, system] : cells_) {
      const Eigen::VectorXd step = damped(all_.hessian - system.hessian).solve(system.gradient);
      sum += step * step.transpose();
    }
    return 0.5 * (sum + sum.transpose());
  }

  Matrix6d of_source(const Eigen::MatrixXd& covariance, std::size_t source) const {
    return covariance.block<6, 6>(poses_[source].at, poses_[source].at);
  }

 private:
  void add(std::size_t source, const CellEquations& sums, BlockSystem& system) const {
    system.add<2>({poses_[source], velocity_}, {kPairPose, kPairVelocity}, sums.gradient,
                  sums.hessian);
  }

  /// The curvature of the robust kernel may make a Hessian indefinite along a direction that is
  /// hardly constrained.
  static Eigen::LDLT<Eigen::MatrixXd> damped(Eigen::MatrixXd hessian) {
    constexpr double kDamping = 1e-6;
    hessian.diagonal() *= 1.0 + kDamping;
    hessian.diagonal().array() += 1e-9;
    return hessian.ldlt();
  }

  Eigen::Index unknowns_ = 0;
  std::vector<Block> poses_;
  Block velocity_;
  Matrix6d prior_ = Matrix6d::Zero();
  BlockSystem all_;
  std::map<JointCell, BlockSystem> cells_;
  std::vector<int> counts_;
};

/// The velocity of a body that moves by `T_before_now` in `interval_s`, for rotations of a few
/// degrees; the inverse of motion_over.
Twist velocity_of_motion(const RigidTransform& T_before_now, double interval_s) {
  const Eigen::Matrix3d& R = T_before_now.rotation;
  const Eigen::Vector3d turn =
      0.5 * Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const Eigen::Vector3d& shift = T_before_now.translation;
  return {turn / interval_s, (shift - 0.5 * turn.cross(shift)) / interval_s};
}

/// The velocity, among many horizontal ones, near which two scans agree best.
Twist best_velocity(const JointScene& scene, double interval_s) {
  constexpr int kDirections = 8;
  constexpr double kMaxSpeed_mps = 40.0, kStep_m = 0.4;
  JointOptions options = audit_options();
  options.points /= 4;
  options.max_distances_m = {1.0, 0.3};
  std::vector<Twist> velocities(1);
  for (int k = 1; k * kStep_m <= kMaxSpeed_mps * interval_s; ++k) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle_rad = 2.0 * kPi * i / kDirections;
      velocities.push_back({Eigen::Vector3d::Zero(),
                            k * kStep_m / interval_s *
                                Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0)});
    }
  }
  std::vector<double> agreements(velocities.size(), 0.0);
  for_each_in_parallel(velocities.size(), [&](std::size_t i) {
    const JointState start = {{motion_over(velocities[i], interval_s).inverse()}, {0.0}, {Twist()}};
    const JointState state = register_jointly({scene}, start, options).state;
    const DeskewedTarget target(scene, Twist(), options);
    const JointView view = last_view(state, Twist(), options);
    for (const auto& point : pair_agreement(scene.sources.front(), target, view).points) {
      agreements[i] += point.agreeing;
    }
    velocities[i] = velocity_of_motion(state.T_target_sensor.front().inverse(), interval_s);
  });
  const auto best = std::max_element(agreements.begin(), agreements.end());
  return velocities[static_cast<std::size_t>(best - agreements.begin())];
}

}  // namespace

Auditor::Auditor(std::vector<RigidTransform> given, bool at_rest)
    : given_(std::move(given)), at_rest_(at_rest) {}

std::optional<Matrix6d> Auditor::find_velocity(const ThinnedScan& reference, double reference_s,
                                               std::optional<double> stamp_s) {
  const TimedScan before = std::exchange(last_reference_, {});
  const double last_s = std::exchange(last_reference_s_, reference_s);
  const std::optional<double> last_stamp_s = std::exchange(last_stamp_s_, stamp_s);
  const std::optional<Twist> last = std::exchange(velocity_, std::nullopt);
  const double interval_s =
      stamp_s && last_stamp_s ? *stamp_s - *last_stamp_s : reference_s - last_s;
  if (!before.cloud || interval_s < kMinInterval_s || interval_s > kMaxInterval_s) return {};
  JointScene scene;
  scene.target = timed_scan(reference, last.value_or(Twist()), reference_s, "moved");
  scene.sources.push_back({0, before});
  std::fill(scene.target.times_s.begin(), scene.target.times_s.end(), 0.0);
  std::fill(scene.sources[0].scan.times_s.begin(), scene.sources[0].scan.times_s.end(), 0.0);
  JointOptions options = audit_options();
  const Twist near = last ? *last : best_velocity(scene, interval_s);
  if (!last) options.max_distances_m = {1.0, 0.3};
  const JointState start = {{motion_over(near, interval_s).inverse()}, {0.0}, {Twist()}};
  const JointRegistration result = register_jointly({scene}, start, options);
  const JackknifeSystem system(scene, result.state, options);
  if (system.correspondences(0) < kMinOverlap * options.points) return {};
  velocity_ = velocity_of_motion(result.state.T_target_sensor.front().inverse(), interval_s);
  Vector6d accelerated;
  accelerated << Eigen::Vector3d::Constant(kAccelerated_radps),
      Eigen::Vector3d::Constant(kAccelerated_mps);
  const Matrix6d of_motion = system.of_source(system.covariance(result.rmse_m * result.rmse_m), 0);
  return of_motion / (interval_s * interval_s) + Matrix6d(accelerated.cwiseAbs2().asDiagonal());
}

std::vector<SensorAudit> Auditor::audit(ReadScan reference,
                                        std::vector<std::optional<ReadScan>> sensors,
                                        std::optional<double> stamp_s) {
  std::vector<SensorAudit> audits(given_.size());
  const auto refuse_all = [&](const std::string& why_not) {
    velocity_.reset();
    last_reference_ = {};
    for (SensorAudit& audit : audits) {
      if (audit.why_not.empty()) audit.why_not = why_not;
    }
    return audits;
  };
  const JointOptions options = audit_options();
  // The scans of all sensors, the reference last.
  std::vector<ThinnedScan> thinned(given_.size() + 1);
  for_each_in_parallel(thinned.size(), [&](std::size_t i) {
    const ReadScan* const read = i == given_.size() ? &reference
                                 : sensors[i]       ? &*sensors[i]
                                                    : nullptr;
    if (read != nullptr && read->is_usable()) thinned[i] = thinned_scan(read->cloud, !at_rest_);
  });
  for (std::size_t i = 0; i < given_.size(); ++i) {
    if (!sensors[i]) {
      audits[i].why_not = "no cloud";
    } else if (thinned[i].points.empty()) {
      audits[i].why_not = "unusable cloud";
    }
  }
  if (thinned.back().points.empty()) return refuse_all("no cloud of the reference");

  JointScene scene;
  JointState state;
  std::vector<std::size_t> used;
  scene.is_moving = thinned.back().has_times;
  scene.reference_s = scene.is_moving ? span_of(thinned.back().times_s).middle_s() : 0.0;
  for (std::size_t i = 0; i < given_.size(); ++i) {
    if (audits[i].why_not.empty() && scene.is_moving) {
      audits[i].why_not = why_not_with(thinned[i], scene.reference_s);
    }
    if (audits[i].why_not.empty()) used.push_back(i);
  }
  if (used.empty()) return refuse_all("no cloud");
  for (ThinnedScan& scan : thinned) scan.has_times = scene.is_moving;
  if (scene.is_moving) {
    scene.velocity_covariance = find_velocity(thinned.back(), scene.reference_s, stamp_s);
  }
  const Twist velocity = velocity_.value_or(Twist());
  if (velocity_) scene.removed = velocity;
  std::vector<TimedScan> scans(thinned.size());
  for_each_in_parallel(thinned.size(), [&](std::size_t i) {
    const bool is_used = i == given_.size() || audits[i].why_not.empty();
    if (!is_used) return;
    const bool is_reference = i == given_.size();
    scans[i] = timed_scan(std::move(thinned[i]),
                          is_reference ? velocity : velocity_in(given_[i].inverse(), velocity),
                          scene.reference_s, std::to_string(i));
    find_normals(*scans[i].cloud, options);
  });
  scene.target = scans.back();
  for (const std::size_t i : used) {
    scene.sources.push_back({state.T_target_sensor.size(), scans[i]});
    state.T_target_sensor.push_back(given_[i]);
  }
  state.clock_offsets_s.assign(used.size(), 0.0);
  state.velocities.assign(1, Twist());
  last_reference_ = scene.target;
  if (scene.is_moving && !velocity_) {
    for (const std::size_t i : used) audits[i].why_not = "the velocity is not known yet";
    return audits;
  }
  const JointRegistration result = register_jointly({scene}, state, options);
  if (scene.is_moving) {
    velocity_ = stepped(velocity, vector_of(result.state.velocities.front()));
  }
  const JackknifeSystem system(scene, result.state, options);
  const Eigen::MatrixXd covariance = system.covariance(result.rmse_m * result.rmse_m);
  for (std::size_t j = 0; j < used.size(); ++j) {
    SensorAudit& audit = audits[used[j]];
    const auto points =
        std::min(scans[used[j]].cloud->points().size(), static_cast<std::size_t>(options.points));
    const double overlap =
        static_cast<double>(system.correspondences(j)) / static_cast<double>(points);
    if (system.correspondences(j) < kMinJointCorrespondences || overlap < kMinOverlap) {
      audit.why_not = "too little overlap with the reference";
      continue;
    }
    audit.difference = pose_error(result.state.T_target_sensor[j], given_[used[j]]).dof;
    audit.covariance = bounded_covariance(system.of_source(covariance, j));
  }
  return audits;
}

}  // namespace croon
