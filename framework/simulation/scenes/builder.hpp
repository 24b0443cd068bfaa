#pragma once

#include <string_view>

#include "framework/simulation/objects/objects.hpp"
#include "framework/simulation/scenes/road_coordinates.hpp"
#include "framework/simulation/scenes/scene.hpp"

namespace croon::simulation {

/// Adds objects to a scene without collisions. Functions that return a bool add the object and
/// return true if its space is free; otherwise they add nothing and return false.
class SceneBuilder {
 public:
  /// A scene with the ground of `shape` and nothing on it. The random streams of its parts are
  /// derived from `key`.
  SceneBuilder(const RoadShape& shape, const StreamKey& key);

  const Ground& ground() const { return ground_; }
  const RoadShape& shape() const { return ground_.shape(); }
  /// The random stream of one part of the scene.
  StreamKey key(std::string_view part) const { return key_.with(part); }

  /// Places the car that carries the sensors. It follows the road and turns by `turn_rate_radps` in
  /// addition.
  void put_car(const RoadPose& pose, const CarBody& body, double speed_mps,
               double turn_rate_radps = 0.0);
  /// Adds an upright object at the minimum height of the ground below it.
  bool place_upright(const Mesh& mesh, const RoadPose& pose);
  /// Adds an object that leans with the slope.
  bool park(const Mesh& mesh, const RoadPose& pose);
  /// Adds an object that leans with the slope and moves ahead: along the road, or straight on
  /// across it.
  bool drive(Mesh mesh, const RoadPose& pose, double speed_mps);
  /// Occupies `box` if it is free.
  bool occupy(const RoadBox& box);
  bool is_free(const RoadBox& box) const { return occupancy_.is_free(box); }
  /// Occupies `box` in any case.
  void keep_clear(const RoadBox& box) { occupancy_.occupy(box); }
  /// Adds a mesh in world coordinates; its space is not occupied.
  void add(const Mesh& mesh) { add(mesh, RigidTransform{}); }
  void add(const Mesh& mesh, const RigidTransform& T_world_mesh) {
    world_.fixed.append(mesh, T_world_mesh);
  }

  /// The scene. Call this function once, at the end.
  World finish();

 private:
  bool occupy_all(const std::array<RoadBox, 2>& boxes);
  Motion motion_at(const RoadPose& pose, double speed_mps) const;

  StreamKey key_;
  Ground ground_;
  Occupancy occupancy_;
  World world_;
};

/// Objects of one type at intervals along a side.
struct Series {
  Mesh (*make)(Rng& rng) = nullptr;
  int meshes = 1;         ///< Number of different meshes.
  Span spacing_m;         ///< Distance from one object to the next.
  Span out_m;             ///< Distance from the centre line.
  double turn_rad = 0.0;  ///< As in Roadside::at.
  bool has_random_turn = false;
  double share = 1.0;  ///< Share of the positions that have an object.
};

/// Adds the objects of `series` along `along_m` whose space is free.
void add_series(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                const Series& series, Rng rng);

/// `mesh` moved along its x axis so that its middle is at 0.
Mesh centred_along_x(Mesh mesh);

}  // namespace croon::simulation
