#pragma once

#include <functional>

#include "framework/base/rng.hpp"
#include "framework/geometry/point_cloud.hpp"
#include "framework/simulation/ray_caster.hpp"
#include "framework/simulation/sensor_model.hpp"

namespace croon::simulation {

/// The start time of a scan, and the pose of the sensor over time.
struct ScanPlan {
  double begin_s = 0.0;
  std::function<RigidTransform(double time_s)> T_world_sensor;
  double clock_offset_s = 0.0;  ///< The sensor's times are too late by this.
};

/// One scan of `world` by `sensor`, in the sensor's frame at the time when the ray was fired, with
/// the channels intensity (0 to 255), ring (if it has rings) and time (s, see ScanPlan), in the
/// order of firing. The intensity is 255 times the share of returned light; as in real sensors, it
/// does not depend on the range. All random numbers come from `key`.
PointCloud scan(const RayCaster& world, const SensorModel& sensor, const Noise& noise,
                const ScanPlan& plan, const StreamKey& key);

}  // namespace croon::simulation
