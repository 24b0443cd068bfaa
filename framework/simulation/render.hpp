#pragma once

#include "framework/picture/image.hpp"
#include "framework/simulation/ray_caster.hpp"

namespace croon::simulation {

/// A camera in the world; its frame looks along x, y to the left, z up.
struct Camera {
  RigidTransform T_world_camera;
  int width = 800;
  int height = 500;
  double width_deg = 75.0;  ///< Angle that the picture's width takes.
};

/// A camera at `eye` that looks at `target`.
Camera looking_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

/// A picture of the world through `camera`, lit from the sky, in the colours of its materials.
Image render(const RayCaster& world, const Camera& camera);

}  // namespace croon::simulation
