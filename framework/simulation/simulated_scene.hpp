#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "framework/geometry/twist.hpp"
#include "framework/picture/image.hpp"
#include "framework/simulation/recipe.hpp"
#include "framework/simulation/scan.hpp"

namespace croon::simulation {

/// The kind of the scene `index` of `recipe`.
SceneKind scene_kind(const Recipe& recipe, std::uint64_t index);

/// The world of the scene `index` of `recipe` and the scans of its sensors, whose times begin with
/// the drive. Both depend only on the recipe and the index. Thread-safe.
class SimulatedScene {
 public:
  SimulatedScene(std::shared_ptr<const Recipe> recipe, std::uint64_t index);

  const World& world() const { return *world_; }
  const RayCaster& caster() const { return caster_; }

  /// One scan of the sensor `name`. Throws std::logic_error if the rig has no such sensor.
  PointCloud scan_of(const std::string& name) const;

  /// The constant velocity of the sensor `name` during its scan, in its own frame. Zero without
  /// sweep distortion, where a scan is instantaneous.
  Twist velocity_of(const std::string& name) const;

  /// A picture of the scene from behind and above the car, lit from the sky, in the colours of its
  /// materials.
  Image picture() const;

 private:
  std::shared_ptr<const Recipe> recipe_;
  StreamKey key_;
  double begin_s_;                      ///< After the beginning of the drive.
  std::shared_ptr<const World> world_;  ///< At that time.
  RayCaster caster_;
};

}  // namespace croon::simulation
