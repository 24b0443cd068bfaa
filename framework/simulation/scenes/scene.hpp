#pragma once

#include "framework/base/rng.hpp"
#include "framework/simulation/ground.hpp"
#include "framework/simulation/scene_kind.hpp"
#include "framework/simulation/world.hpp"

namespace croon::simulation {

/// Space that the car with the sensors takes: nothing else may stand in it.
struct CarSpace {
  double length_m = 4.7;
  double width_m = 1.9;
};

/// A scene of `kind` without the car with the sensors: that stands at `T_world_car` of the result's
/// `car`, whose mesh is empty; car frame: x forward, y left, z up, origin on the road below its
/// middle.
World make_scene(SceneKind kind, const CarSpace& car, const StreamKey& key);

}  // namespace croon::simulation
