#pragma once

#include <optional>
#include <vector>

#include "framework/base/rng.hpp"
#include "framework/calibration/calibrated_rig.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The pose of the reference over the road from its clouds, one per scene, in its own frame:
/// a plane through the ground within 15 m, and the mean over the scenes. The standard deviations
/// are those of a jackknife over directions of view, because the unevenness of a road does not
/// average out over points, and of the differences between scenes. The reference may be tilted by
/// up to 60 degrees, upright or upside down. std::nullopt if no scene shows enough ground.
std::optional<GroundPose> ground_pose(const std::vector<const Points*>& scenes, Rng& rng);

/// T_road_reference of a ground pose.
RigidTransform road_from_reference(const GroundPose& ground);

/// The heading of a rig that drives, from the velocities of its reference. Scenes that are slower
/// than 1 m/s, or in which the rig turns so much that a lever of 2 m would matter, take no part. A
/// scene against the majority drives backwards. std::nullopt if no scene is left.
std::optional<HeadingOfTravel> heading_of_travel(const std::vector<SceneMotionEstimate>& motion,
                                                 const std::optional<GroundPose>& ground);

}  // namespace croon
