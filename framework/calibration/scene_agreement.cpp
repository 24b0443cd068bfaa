#include "framework/calibration/scene_agreement.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "framework/geometry/guarded_inverse.hpp"
#include "framework/geometry/pose_covariance.hpp"
#include "framework/geometry/pose_mean.hpp"

namespace croon {
namespace {

/// The pose of a scene with the information that remains when real sensors scatter.
InformedPose scattered(const ScenePose& scene) {
  Matrix6d covariance = bounded_covariance(scene.covariance);
  for (int i = 0; i < 6; ++i) {
    const double scatter = is_rotation(static_cast<Dof>(i)) ? kSceneScatter_rad : kSceneScatter_m;
    covariance(i, i) += scatter * scatter;
  }
  return informed(scene.T_reference_sensor, covariance);
}

double squared_distance(const InformedPose& a, const InformedPose& b) {
  const Matrix6d covariance = guarded_inverse<6>(a.information) + guarded_inverse<6>(b.information);
  const Vector6d apart = pose_error(a.pose, b.pose).dof;
  return apart.dot(covariance.ldlt().solve(apart));
}

/// The two poses that differ the most.
std::array<InformedPose, 2> most_different(const std::vector<InformedPose>& poses) {
  std::array<InformedPose, 2> pair = {poses.front(), poses.front()};
  double largest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t j = i + 1; j < poses.size(); ++j) {
      const double distance = squared_distance(poses[i], poses[j]);
      if (distance <= largest) continue;
      largest = distance;
      pair = {poses[i], poses[j]};
    }
  }
  return pair;
}

}  // namespace

std::optional<SceneSplit> split_of_scenes(const std::vector<ScenePose>& poses) {
  std::vector<InformedPose> scenes;
  for (const ScenePose& pose : poses) scenes.push_back(scattered(pose));
  if (scenes.size() < 2) return std::nullopt;
  std::array<InformedPose, 2> centres = most_different(scenes);
  std::array<std::vector<std::size_t>, 2> groups;
  constexpr int kRounds = 4;  // Assignments rarely change after the second.
  for (int round = 0; round < kRounds; ++round) {
    std::array<std::vector<InformedPose>, 2> members;
    groups = {};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const bool is_second =
          squared_distance(scenes[i], centres[1]) < squared_distance(scenes[i], centres[0]);
      groups.at(is_second ? 1 : 0).push_back(i);
      members.at(is_second ? 1 : 0).push_back(scenes[i]);
    }
    if (groups[0].empty() || groups[1].empty()) return std::nullopt;
    centres = {informed_mean(members[0]), informed_mean(members[1])};
  }
  SceneSplit split;
  split.deviations = std::sqrt(std::max(0.0, squared_distance(centres[0], centres[1])));
  if (split.deviations <= kMaxSceneDistance) return std::nullopt;
  split.apart = pose_error(centres[0].pose, centres[1].pose);
  const bool is_second_larger = groups[0].size() != groups[1].size()
                                    ? groups[0].size() < groups[1].size()
                                    : groups[1].front() < groups[0].front();
  split.larger = std::move(groups.at(is_second_larger ? 1 : 0));
  split.smaller = std::move(groups.at(is_second_larger ? 0 : 1));
  return split;
}

}  // namespace croon
