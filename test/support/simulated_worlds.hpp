#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <vector>

#include "framework/simulation/ground.hpp"
#include "framework/simulation/ray_caster.hpp"
#include "framework/simulation/recipe.hpp"

namespace croon::test {

/// A recipe of scenes of one kind.
std::shared_ptr<const simulation::Recipe> recipe_of(simulation::SceneKind kind,
                                                    const simulation::Noise& noise = {});

/// The least box around the vertices of `mesh`.
Eigen::AlignedBox3d bounds_of(const simulation::Mesh& mesh);

/// A caster of rays at `mesh` alone.
std::unique_ptr<simulation::RayCaster> caster_of(const simulation::Mesh& mesh);

using Triangle = std::array<Eigen::Vector3d, 3>;

/// The triangles of `mesh`, moved by `T`.
std::vector<Triangle> triangles_of(const simulation::Mesh& mesh, const RigidTransform& T = {});

/// All triangles of `world` at time 0, in the world; those of the ground come first.
std::vector<Triangle> triangles_of(const simulation::World& world);

/// A road with a random bend, width and slopes, without a crossing.
simulation::RoadShape random_road(Rng& rng);

/// Road coordinates (s, d) of a position in the world, the inverse of Ground::point.
Eigen::Vector2d road_coordinates(const simulation::RoadShape& shape,
                                 const Eigen::Vector3d& position);

/// The objects of a scene with a road of `shape`: its fixed mesh without the ground, which comes
/// first.
simulation::Mesh without_ground(const simulation::World& world, const simulation::RoadShape& shape);

/// True if `point`, in the car's frame, is inside the car seen from above.
bool is_in_car(const simulation::CarBody& car, const Eigen::Vector3f& point);

/// The mean road coordinates of each object in `objects`, which have `vertices` vertices each.
std::vector<Eigen::Vector2d> positions_in(const simulation::Mesh& objects,
                                          const simulation::RoadShape& shape, std::size_t vertices);

}  // namespace croon::test
