#pragma once

#include "framework/simulation/scenes/scene.hpp"

namespace croon::simulation {

/// One function for each SceneKind, each in a file of its name: make_scene is the way to them.
World make_urban(const CarSpace& car, const StreamKey& key);
World make_suburban(const CarSpace& car, const StreamKey& key);
World make_highway(const CarSpace& car, const StreamKey& key);
World make_crossing(const CarSpace& car, const StreamKey& key);
World make_car_park(const CarSpace& car, const StreamKey& key);
World make_empty(const CarSpace& car, const StreamKey& key);
World make_narrow(const CarSpace& car, const StreamKey& key);
World make_blocked(const CarSpace& car, const StreamKey& key);
World make_corridor(const CarSpace& car, const StreamKey& key);

}  // namespace croon::simulation
