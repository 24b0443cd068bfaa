#pragma once

#include "framework/simulation/scenes/roadside.hpp"

namespace croon::simulation {

/// A long wall without relief.
struct SmoothWall {
  Interval along_m;
  double face_m = 5.0;  ///< How far out its face is.
  double height_m = 5.0;
  Material material = Material::concrete;
};

/// Adds the wall, 1 m thick, and takes its space and all that is behind it.
void add_smooth_wall(SceneBuilder& builder, const Roadside& side, const SmoothWall& wall);

/// A flat ceiling between the faces of two walls, at the height of the lower one.
void add_ceiling(SceneBuilder& builder, const std::array<SmoothWall, 2>& walls);

}  // namespace croon::simulation
