#include "framework/geometry/pose_mean.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "framework/base/statistics.hpp"
#include "framework/geometry/guarded_inverse.hpp"

namespace croon {

namespace {

/// The medoid of more poses is computed on a sample, because its time grows with their square.
constexpr std::size_t kMedoidSample = 2000;

template <class Pose>
void require_poses(const std::vector<Pose>& poses) {
  if (poses.empty()) throw std::logic_error("a mean of no poses");
}

/// A pose and the number of its votes.
struct Vote {
  RigidTransform pose;
  double weight = 1.0;
};

bool is_before(const Vote& a, const Vote& b) {
  const RigidTransform &p = a.pose, &q = b.pose;
  if (p.translation != q.translation) {
    return std::lexicographical_compare(p.translation.data(), p.translation.data() + 3,
                                        q.translation.data(), q.translation.data() + 3);
  }
  if (p.rotation != q.rotation) {
    return std::lexicographical_compare(p.rotation.data(), p.rotation.data() + 9, q.rotation.data(),
                                        q.rotation.data() + 9);
  }
  return a.weight < b.weight;
}

/// In a fixed order, so that sums do not depend on the order of the input.
std::vector<Vote> in_fixed_order(const std::vector<RigidTransform>& poses,
                                 const std::vector<double>& weights = {}) {
  if (!weights.empty() && weights.size() != poses.size()) {
    throw std::logic_error("not one weight per pose");
  }
  std::vector<Vote> votes;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    votes.push_back({poses[i], weights.empty() ? 1.0 : weights[i]});
  }
  std::sort(votes.begin(), votes.end(), is_before);
  return votes;
}

std::vector<RigidTransform> poses_of(const std::vector<Vote>& votes) {
  std::vector<RigidTransform> poses;
  for (const Vote& vote : votes) poses.push_back(vote.pose);
  return poses;
}

/// `length` as a multiple of `bound`, which may be zero.
double multiple(double length, double bound) { return length == 0.0 ? 0.0 : length / bound; }

/// A pose whose rotation is a quaternion: the consensus of n poses needs n^2 / 2 angles, each of
/// which is three times as expensive for rotation matrices.
struct QuaternionPose {
  Eigen::Quaterniond rotation;
  Eigen::Vector3d translation;
};

/// The larger of rotation and translation between two poses, each as a multiple of its bound.
double distance_in_bounds(const QuaternionPose& a, const QuaternionPose& b,
                          const PoseBounds& bounds) {
  const Eigen::Quaterniond q = a.rotation * b.rotation.conjugate();
  const double rotation_rad = 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
  return std::max(multiple(rotation_rad, bounds.rotation_rad),
                  multiple((a.translation - b.translation).norm(), bounds.translation_m));
}

/// Evenly spaced elements of the sorted poses; all of them if they are few.
std::vector<Vote> sample_of(const std::vector<Vote>& ordered) {
  if (ordered.size() <= kMedoidSample) return ordered;
  std::vector<Vote> sample;
  for (std::size_t i = 0; i < kMedoidSample; ++i) {
    sample.push_back(ordered[i * ordered.size() / kMedoidSample]);
  }
  return sample;
}

/// The index of the pose with the most neighbours; see `consensus_pose`.
std::size_t medoid(const std::vector<Vote>& votes, const PoseBounds& bounds) {
  std::vector<QuaternionPose> quaternions;
  for (const Vote& vote : votes) {
    quaternions.push_back({Eigen::Quaterniond(vote.pose.rotation), vote.pose.translation});
  }
  std::vector<std::pair<double, double>> cost(votes.size(), {0.0, 0.0});
  for (std::size_t i = 0; i < votes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = distance_in_bounds(quaternions[i], quaternions[j], bounds);
      for (const auto& [k, other] : {std::pair(i, j), std::pair(j, i)}) {
        cost[k].first += votes[other].weight * std::min(1.0, distance);
        cost[k].second += votes[other].weight * distance;
      }
    }
  }
  return static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
}

/// `mean_pose` of poses in their fixed order.
RigidTransform mean_of_ordered(const std::vector<RigidTransform>& poses) {
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
  std::array<std::vector<double>, 3> coordinates;
  for (const RigidTransform& pose : poses) {
    const Eigen::Vector4d q = Eigen::Quaterniond(pose.rotation).coeffs();
    M += q * q.transpose();
    for (int k = 0; k < 3; ++k)
      coordinates[static_cast<std::size_t>(k)].push_back(pose.translation(k));
  }
  // Eigenvalues are in increasing order.
  const Eigen::Vector4d q = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(M).eigenvectors().col(3);
  return {Eigen::Quaterniond(q).normalized().toRotationMatrix(),
          {mean(coordinates[0]), mean(coordinates[1]), mean(coordinates[2])}};
}

/// The pose with the most neighbours.
RigidTransform centre_of(const std::vector<Vote>& ordered, const PoseBounds& bounds) {
  const std::vector<Vote> sample = sample_of(ordered);
  return sample[medoid(sample, bounds)].pose;
}

}  // namespace

bool agree(const RigidTransform& a, const RigidTransform& b, const PoseBounds& bounds) {
  // As in pose_error, but without Euler angles, because this is called for every trial.
  return (a.translation - b.translation).norm() <= bounds.translation_m &&
         rotation_angle(a.rotation * b.rotation.transpose()) <= bounds.rotation_rad;
}

RigidTransform mean_pose(const std::vector<RigidTransform>& poses) {
  require_poses(poses);
  return mean_of_ordered(poses_of(in_fixed_order(poses)));
}

InformedPose informed(const RigidTransform& pose, const Matrix6d& covariance) {
  return {pose, guarded_inverse<6>(covariance)};
}

InformedPose informed_mean(const std::vector<InformedPose>& poses) {
  require_poses(poses);
  InformedPose mean = poses.front();
  if (poses.size() == 1) return mean;
  mean.information.setZero();
  for (const InformedPose& one : poses) mean.information += one.information;
  const Matrix6d covariance = guarded_inverse<6>(mean.information);
  // Offsets are linear only to first order; the poses are close, so a few rounds suffice.
  for (int i = 0; i < 5; ++i) {
    Vector6d pull = Vector6d::Zero();
    for (const InformedPose& one : poses) {
      pull += one.information * pose_error(one.pose, mean.pose).dof;
    }
    mean.pose = moved(mean.pose, covariance * pull);
  }
  return mean;
}

RigidTransform consensus_pose(const std::vector<RigidTransform>& poses, const PoseBounds& bounds,
                              const std::vector<double>& weights) {
  require_poses(poses);
  const std::vector<Vote> ordered = in_fixed_order(poses, weights);
  // The mean of one pose would differ from it in the last digits.
  if (ordered.size() == 1) return ordered.front().pose;
  const RigidTransform centre = centre_of(ordered, bounds);
  std::vector<RigidTransform> near;
  for (const Vote& vote : ordered) {
    if (agree(vote.pose, centre, bounds)) near.push_back(vote.pose);
  }
  // Due to rounding, a pose may not agree with itself if the bounds are zero.
  return near.empty() ? centre : mean_of_ordered(near);
}

std::vector<std::size_t> consensus_members(const std::vector<RigidTransform>& poses,
                                           const PoseBounds& bounds,
                                           const std::vector<double>& weights) {
  require_poses(poses);
  const RigidTransform centre = centre_of(in_fixed_order(poses, weights), bounds);
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool is_centre =
        poses[i].rotation == centre.rotation && poses[i].translation == centre.translation;
    if (is_centre || agree(poses[i], centre, bounds)) members.push_back(i);
  }
  return members;
}

RigidTransform common_start(const std::vector<RigidTransform>& poses) {
  return consensus_pose(poses, kNearStart);
}

}  // namespace croon
