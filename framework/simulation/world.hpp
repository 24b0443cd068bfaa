#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// How a body moves: along its own x axis, turning about its own z axis, both steady.
struct Motion {
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
};

/// Something that moves as a whole.
struct Body {
  Mesh mesh;  ///< In the body's frame: x forward, z up, origin on the ground below.
  RigidTransform T_world_body;  ///< At time 0.
  Motion motion;

  /// `T_world_body` at `time_s`.
  RigidTransform pose_at(double time_s) const;
};

/// All that rays can meet in one scene. World frame: near the car, z up, metres.
struct World {
  Mesh fixed;
  std::vector<Body> bodies;  ///< What moves, but the car that carries the sensors.
  Body car;                  ///< The car that carries them.
};

}  // namespace croon::simulation
