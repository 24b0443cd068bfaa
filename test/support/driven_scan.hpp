#pragma once

#include <vector>

#include "framework/geometry/point_cloud.hpp"
#include "framework/geometry/twist.hpp"

namespace croon::test {

/// What a sensor at `T_body_sensor` of a body with `velocity` measures of `world`, surfaces at rest
/// that are in the sensor's frame at the time `reference_s`: one point at each of `times_s`, which
/// are the channel time.
PointCloud driven_scan(const Points& world, const std::vector<double>& times_s, double reference_s,
                       const Twist& velocity, const RigidTransform& T_body_sensor = {});

}  // namespace croon::test
