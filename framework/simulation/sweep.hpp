#pragma once

#include <functional>

#include "framework/base/rng.hpp"
#include "framework/geometry/measured_cloud.hpp"
#include "framework/simulation/noise.hpp"
#include "framework/simulation/ray_caster.hpp"
#include "framework/simulation/sensor_model.hpp"

namespace croon::simulation {

/// `T_world_sensor` at a time.
using SensorPath = std::function<RigidTransform(double time_s)>;

/// When a sensor begins to sweep, and where it is then and after.
struct SweepPlan {
  double begin_s = 0.0;
  SensorPath T_world_sensor;
};

/// One sweep of `sensor` through `world`. Intensity is the share of light sent back, of 255; range
/// is left out of it, as sensors do. All draws come from `key`.
MeasuredCloud sweep(const RayCaster& world, const SensorModel& sensor, const Noise& noise,
                    const SweepPlan& plan, const StreamKey& key);

}  // namespace croon::simulation
