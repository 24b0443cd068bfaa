#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "framework/simulation/recipe.hpp"
#include "framework/simulation/render.hpp"
#include "framework/simulation/sweep.hpp"

namespace croon::simulation {

/// What kind of scene the scene `index` of `recipe` is.
SceneKind scene_kind(const Recipe& recipe, std::uint64_t index);

/// The scene `index` of `recipe`, built: its world, and what its sensors see. Depends on these two
/// alone. May be asked from many threads.
class SimulatedScene {
 public:
  SimulatedScene(std::shared_ptr<const Recipe> recipe, std::uint64_t index);

  const World& world() const { return *world_; }
  const RayCaster& caster() const { return caster_; }

  /// One sweep of the sensor `name`, which the rig must have.
  MeasuredCloud sweep_of(const std::string& name) const;

 private:
  std::shared_ptr<const Recipe> recipe_;
  StreamKey key_;
  std::shared_ptr<const World> world_;
  RayCaster caster_;
};

/// The scene through a camera behind and above its car.
Image bird_view(const SimulatedScene& scene);

}  // namespace croon::simulation
