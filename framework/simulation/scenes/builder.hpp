#pragma once

#include <string_view>

#include "framework/base/rng.hpp"
#include "framework/simulation/ground.hpp"
#include "framework/simulation/scenes/road_box.hpp"
#include "framework/simulation/scenes/scene.hpp"

namespace croon::simulation {

/// Puts objects into a scene and sees to it that none stands in another. What returns a bool says
/// whether there was room; where there was none nothing was added.
class SceneBuilder {
 public:
  /// A scene with the ground of `shape` and nothing on it; its parts draw from streams below `key`.
  SceneBuilder(const RoadShape& shape, const StreamKey& key);

  const Ground& ground() const { return ground_; }
  const RoadShape& shape() const { return ground_.shape(); }
  /// The stream of one part of the scene.
  StreamKey key(std::string_view part) const { return key_.with(part); }

  /// Puts the car that carries the sensors, which follows the road and turns by `turn_rate_radps`
  /// besides.
  void put_car(const Place& place, const CarSpace& space, double speed_mps,
               double turn_rate_radps = 0.0);
  /// An upright object, at the lowest ground below it.
  bool stand(const Mesh& mesh, const Place& place);
  /// An object that leans with the slope.
  bool park(const Mesh& mesh, const Place& place);
  /// The same, moving ahead along the road, or straight on where it is across it.
  bool drive(Mesh mesh, const Place& place, double speed_mps);
  /// Takes a space, as the objects above do.
  bool take(const RoadBox& box);
  bool is_free(const RoadBox& box) const { return occupancy_.is_free(box); }
  /// Takes a space, whatever stands there.
  void keep_clear(const RoadBox& box) { occupancy_.take(box); }
  /// Adds a mesh in world coordinates, whatever stands there.
  void add(const Mesh& mesh) { world_.fixed.append(mesh, RigidTransform{}); }

  /// The scene; call it once, at the end.
  World finish();

 private:
  bool take_all(const std::array<RoadBox, 2>& boxes);
  Motion motion_at(const Place& place, double speed_mps) const;

  StreamKey key_;
  Ground ground_;
  Occupancy occupancy_;
  World world_;
};

}  // namespace croon::simulation
