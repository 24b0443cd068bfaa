#include "framework/simulation/scenes/scene.hpp"

#include <stdexcept>

#include "framework/simulation/scenes/kinds.hpp"

namespace croon::simulation {

World make_scene(SceneKind kind, const CarSpace& car, const StreamKey& key) {
  switch (kind) {
    case SceneKind::urban:
      return make_urban(car, key);
    case SceneKind::suburban:
      return make_suburban(car, key);
    case SceneKind::highway:
      return make_highway(car, key);
    case SceneKind::crossing:
      return make_crossing(car, key);
    case SceneKind::car_park:
      return make_car_park(car, key);
    case SceneKind::empty:
      return make_empty(car, key);
    case SceneKind::narrow:
      return make_narrow(car, key);
    case SceneKind::blocked:
      return make_blocked(car, key);
    case SceneKind::corridor:
      return make_corridor(car, key);
  }
  throw std::logic_error("make_scene: a kind without a scene");
}

}  // namespace croon::simulation
