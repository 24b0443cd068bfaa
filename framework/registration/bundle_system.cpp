#include "framework/registration/bundle_system.hpp"

#include <algorithm>
#include <iterator>

#include "framework/base/angles.hpp"
#include "framework/base/threads.hpp"
#include "framework/geometry/guarded_inverse.hpp"

namespace croon {
namespace {

/// The offset of `T` from `start`, in the order of Dof.
Vector6d moved_by(const RigidTransform& T, const RigidTransform& start) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(T.rotation * start.rotation.transpose()));
  Vector6d offset;
  offset << turn.angle() * turn.axis(), T.translation - start.translation;
  return offset;
}

}  // namespace

ReducedCost reduced(const BlockSystem& cost, bool has_velocity) {
  ReducedCost result = {cost.gradient, cost.hessian, {}, {}};
  if (!has_velocity) return result;
  const Eigen::Index size = cost.gradient.size() - 6;
  const Matrix6d inverse = guarded_inverse<6>(cost.hessian.bottomRightCorner<6, 6>());
  const Eigen::MatrixXd mixed = cost.hessian.bottomLeftCorner(6, size);
  result.by_pose = -inverse * mixed;
  result.rest = -inverse * cost.gradient.tail<6>();
  result.gradient = cost.gradient.head(size) + mixed.transpose() * result.rest;
  result.hessian = cost.hessian.topLeftCorner(size, size) + mixed.transpose() * result.by_pose;
  return result;
}

BundleSystem::BundleSystem(const std::vector<BundleScene>& scenes,
                           const std::vector<InformedPose>& start, const BundleOptions& options)
    : scenes_(scenes), start_(start), options_(options) {
  prior_std_ << Eigen::Vector3d::Constant(rad_from_deg(options.prior_std[0])),
      Eigen::Vector3d::Constant(options.prior_std[1]);
  for (const InformedPose& one : start) state_.poses.push_back(one.pose);
  state_.clock_offsets_s.assign(start.size(), 0.0);
  for (const BundleScene& scene : scenes) {
    const bool is_certain = scene.motion_covariance.isZero(0.0);
    state_.velocities.push_back(is_certain ? std::nullopt : std::optional<Twist>(Twist()));
    Matrix6d information = Matrix6d::Zero();
    if (!is_certain) {
      information = options.prior_weight * guarded_inverse<6>(scene.motion_covariance);
    }
    velocity_information_.push_back(information);
  }
  planes_velocities_ = state_.velocities;
}

void BundleSystem::find_planes(int stride) {
  planes_velocities_ = state_.velocities;
  free_sensors_.clear();
  for (std::size_t k = 1; k < state_.poses.size(); ++k) free_sensors_.push_back(k);
  planes_of_sensors_.assign(state_.poses.size(), 0);
  for (;;) {
    search_planes(stride);
    const std::vector<int> planes = counted_planes();
    planes_of_sensors_[0] = planes[0];
    for (const std::size_t k : free_sensors_) planes_of_sensors_[k] = planes[k];
    // The one with the fewest planes is removed first: others may share planes only with it.
    const auto weakest =
        std::min_element(free_sensors_.begin(), free_sensors_.end(),
                         [&](std::size_t a, std::size_t b) { return planes[a] < planes[b]; });
    if (weakest == free_sensors_.end() || planes[*weakest] >= options_.min_planes) break;
    // Its points have distorted planes of the others, so the planes are searched again.
    state_.poses[*weakest] = start_[*weakest].pose;
    state_.clock_offsets_s[*weakest] = 0.0;
    free_sensors_.erase(weakest);
  }
  pose_blocks_.assign(state_.poses.size(), {});
  clock_blocks_.assign(state_.poses.size(), {});
  unknowns_ = 0;
  for (const std::size_t k : free_sensors_) pose_blocks_[k] = appended_block(6, unknowns_);
  if (!has_offsets()) return;
  for (const std::size_t k : free_sensors_) clock_blocks_[k] = appended_block(1, unknowns_);
}

void BundleSystem::search_planes(int stride) {
  planes_.resize(scenes_.size());
  const auto takes_part = [&](const SensorCloud& cloud) {
    return cloud.sensor == 0 ||
           std::binary_search(free_sensors_.begin(), free_sensors_.end(), cloud.sensor);
  };
  for_each_in_parallel(scenes_.size(), [&](std::size_t s) {
    const std::vector<SensorCloud>& all = scenes_[s].clouds;
    const RigState state = {poses_in(state_, s), state_.velocities[s]};
    // Usually all do; then the clouds' times need not be copied.
    if (std::all_of(all.begin(), all.end(), takes_part)) {
      planes_[s] = plane_patches(all, state, stride, options_);
      return;
    }
    std::vector<SensorCloud> clouds;
    std::copy_if(all.begin(), all.end(), std::back_inserter(clouds), takes_part);
    planes_[s] = plane_patches(clouds, state, stride, options_);
  });
}

std::size_t BundleSystem::number_of_planes() const {
  std::size_t number = 0;
  for (const auto& of_scene : planes_) number += of_scene.size();
  return number;
}

std::vector<int> BundleSystem::counted_planes() const {
  std::vector<int> planes(state_.poses.size(), 0);
  for (const auto& of_scene : planes_) {
    for (const PlanePatch& patch : of_scene) {
      for (const PlanePatch::View& view : patch.views) ++planes[view.sensor];
    }
  }
  return planes;
}

Twist BundleSystem::velocity_in_scene(const BundleState& state, std::size_t scene) const {
  const std::optional<Twist>& rest = state.velocities[scene];
  const Twist& known = scenes_[scene].velocity;
  return rest ? stepped(known, vector_of(*rest)) : known;
}

std::vector<RigidTransform> BundleSystem::poses_in(const BundleState& state,
                                                   std::size_t scene) const {
  std::vector<RigidTransform> poses = state.poses;
  if (!has_offsets()) return poses;
  const Twist velocity = velocity_in_scene(state, scene);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    poses[k] = motion_over(velocity, state.clock_offsets_s[k]) * poses[k];
  }
  return poses;
}

RigState BundleSystem::rig_state(const BundleState& state, std::size_t scene) const {
  RigState result = {poses_in(state, scene), state.velocities[scene]};
  if (result.velocity) {
    result.velocity = stepped(*result.velocity, -vector_of(*planes_velocities_[scene]));
  }
  return result;
}

BlockSystem BundleSystem::with_offsets(const BlockSystem& cost, std::size_t scene) const {
  const bool has_velocity = state_.velocities[scene].has_value();
  const Twist velocity = velocity_in_scene(state_, scene);
  const std::vector<RigidTransform> poses = poses_in(state_, scene);
  // The Jacobian of the poses in the scene, and of its velocity, with respect to the unknowns.
  Eigen::MatrixXd follow =
      Eigen::MatrixXd::Zero(cost.gradient.size(), unknowns_ + (has_velocity ? 6 : 0));
  for (const std::size_t sensor : free_sensors_) {
    const Eigen::Index at = pose_blocks_[sensor].at;
    const double offset_s = state_.clock_offsets_s[sensor];
    const Eigen::Matrix3d turn = motion_over(velocity, offset_s).rotation;
    const Matrix6d along = velocity_at(poses[sensor].translation);
    follow.block<3, 3>(at, at) = turn;
    follow.block<3, 3>(at + 3, at + 3) = turn;
    follow.block<6, 1>(at, clock_blocks_[sensor].at) = along * vector_of(velocity);
    if (has_velocity) follow.block<6, 6>(at, unknowns_) = offset_s * along;
  }
  if (has_velocity) follow.bottomRightCorner<6, 6>().setIdentity();
  // The second derivatives of exp(xi d) T are neglected, as in Gauss-Newton: with offsets the
  // Hessian is approximate.
  return {follow.transpose() * cost.gradient, follow.transpose() * cost.hessian * follow};
}

double BundleSystem::value_in(const BundleState& state) const {
  double sum = start_value(state);
  for (std::size_t s = 0; s < scenes_.size(); ++s) {
    sum += bundle_value(planes_[s], rig_state(state, s), options_.kernel_width);
    if (!state.velocities[s]) continue;
    const Vector6d velocity = vector_of(*state.velocities[s]);
    sum += velocity.dot(velocity_information_[s] * velocity);
  }
  return sum;
}

BlockSystem BundleSystem::scene_cost(std::size_t scene, const std::vector<PlanePatch>& planes,
                                     bool with_prior) const {
  BlockSystem cost =
      bundle_cost(planes, rig_state(state_, scene), options_.kernel_width, pose_blocks_);
  if (has_offsets()) cost = with_offsets(cost, scene);
  const std::optional<Twist>& velocity = state_.velocities[scene];
  if (velocity && with_prior) {
    const Block block = {unknowns_, 6};
    const Matrix6d& information = velocity_information_[scene];
    cost.add(block, 2.0 * information * vector_of(*velocity));
    cost.add(block, block, 2.0 * information);
  }
  return cost;
}

BlockSystem BundleSystem::start_cost() const {
  BlockSystem cost = BlockSystem::zero(unknowns_);
  for (const std::size_t sensor : free_sensors_) {
    const Block &pose = pose_blocks_[sensor], &clock = clock_blocks_[sensor];
    const Matrix6d information = start_information(sensor);
    cost.add(pose, 2.0 * information * moved_by(state_.poses[sensor], start_[sensor].pose));
    cost.add(pose, pose, 2.0 * information);
    if (!clock) continue;
    const double of_clock = 1.0 / (options_.clock_offset_std_s * options_.clock_offset_std_s);
    cost.gradient(clock.at) = 2.0 * of_clock * state_.clock_offsets_s[sensor];
    cost.hessian(clock.at, clock.at) = 2.0 * of_clock;
  }
  return cost;
}

Eigen::MatrixXd BundleSystem::start_scatter() const {
  // The cost is twice the negative log-likelihood: the gradient of a term with the Hessian 2 w I
  // has the covariance 4 w^2 I, if the term's covariance is the inverse of I.
  Eigen::MatrixXd scatter = 2.0 * start_cost().hessian;
  for (const std::size_t sensor : free_sensors_) {
    const Eigen::Index at = pose_blocks_[sensor].at;
    const double w = options_.prior_weight;
    scatter.block<6, 6>(at, at) -= 4.0 * w * (1.0 - w) * start_[sensor].information;
  }
  return scatter;
}

Matrix6d BundleSystem::start_information(std::size_t sensor) const {
  Matrix6d information = options_.prior_weight * start_[sensor].information;
  information.diagonal() += prior_std_.cwiseAbs2().cwiseInverse();
  return information;
}

double BundleSystem::start_value(const BundleState& state) const {
  double sum = 0.0;
  for (std::size_t k = 1; k < state.poses.size(); ++k) {
    const Vector6d off = moved_by(state.poses[k], start_[k].pose);
    sum += off.dot(start_information(k) * off);
    if (!has_offsets()) continue;
    const double offset = state.clock_offsets_s[k] / options_.clock_offset_std_s;
    sum += offset * offset;
  }
  return sum;
}

}  // namespace croon
