#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"

namespace croon {

/// The pose of one sensor from one scene alone, and the covariance of its error.
struct ScenePose {
  RigidTransform T_reference_sensor;
  Matrix6d covariance = Matrix6d::Zero();
};

/// Standard deviations per axis by which the poses of real sensors differ from scene to scene, in
/// addition to their covariances.
inline constexpr double kSceneScatter_rad = rad_from_deg(0.1);
inline constexpr double kSceneScatter_m = 0.02;

/// The Mahalanobis distance above which the poses of two groups of scenes differ. The distance
/// between two poses with normal errors of the stated size exceeds it once in 18,000 times.
inline constexpr double kMaxSceneDistance = 5.4;

/// Two groups of scenes between which the pose of a sensor differs.
struct SceneSplit {
  std::vector<std::size_t> larger, smaller;  ///< Indices of scenes, ascending.
  PoseError apart;                           ///< Between the mean poses of the groups.
  double deviations = 0.0;                   ///< Their Mahalanobis distance.
};

/// The two groups of `poses` that differ the most, started with the two poses that differ the most;
/// std::nullopt if they differ by at most kMaxSceneDistance, with the scatter of real sensors added
/// to each covariance. Of groups of the same size, the one with the first scene is `larger`.
std::optional<SceneSplit> split_of_scenes(const std::vector<ScenePose>& poses);

}  // namespace croon
