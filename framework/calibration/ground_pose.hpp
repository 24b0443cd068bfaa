#pragma once

#include <optional>
#include <vector>

#include "framework/base/rng.hpp"
#include "framework/calibration/calibrated_rig.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The pose of the reference above the road from its clouds, one per scene, in its own frame: a
/// plane through the ground within 15 m, averaged over the scenes. The standard deviations are from
/// a jackknife over viewing directions, because the unevenness of a road does not average out over
/// points, and from the differences between scenes. The reference may be tilted by up to 60
/// degrees, upright or upside down. std::nullopt if no scene shows enough ground.
std::optional<GroundPose> ground_pose(const std::vector<const Points*>& scenes, Rng& rng);

/// T_road_reference of a ground pose.
RigidTransform road_from_reference(const GroundPose& ground);

/// The heading of a driving rig, from the velocities of its reference. Scenes slower than 1 m/s, or
/// in which the rig turns so fast that a lever arm of 2 m would matter, are ignored. A scene
/// opposite to the majority is taken as driving backwards. std::nullopt if no scene is left.
std::optional<HeadingOfTravel> heading_of_travel(const std::vector<SceneMotionEstimate>& motion,
                                                 const std::optional<GroundPose>& ground);

}  // namespace croon
