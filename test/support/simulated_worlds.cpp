#include "test/support/simulated_worlds.hpp"

#include <cmath>

namespace croon::test {

using Eigen::Vector2d;
using Eigen::Vector3d;
using simulation::Mesh;

std::shared_ptr<const simulation::Recipe> recipe_of(simulation::SceneKind kind,
                                                    const simulation::Noise& noise) {
  auto recipe = std::make_shared<simulation::Recipe>();
  recipe->mix = simulation::mix_of(kind);
  recipe->noise = noise;
  return recipe;
}

Eigen::AlignedBox3d bounds_of(const Mesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3f& vertex : mesh.vertices) bounds.extend(vertex.cast<double>().eval());
  return bounds;
}

std::unique_ptr<simulation::RayCaster> caster_of(const Mesh& mesh) {
  auto world = std::make_shared<simulation::World>();
  world->fixed = mesh;
  return std::make_unique<simulation::RayCaster>(world, simulation::Span{});
}

std::vector<Triangle> triangles_of(const Mesh& mesh, const RigidTransform& T) {
  std::vector<Triangle> triangles;
  for (const auto& corners : mesh.triangles) {
    Triangle& triangle = triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[i] = T * mesh.vertices[corners[i]].cast<double>();
    }
  }
  return triangles;
}

std::vector<Triangle> triangles_of(const simulation::World& world) {
  std::vector<Triangle> triangles = triangles_of(world.fixed);
  const auto add = [&](const simulation::Body& body) {
    const std::vector<Triangle> own = triangles_of(body.mesh, body.T_world_body);
    triangles.insert(triangles.end(), own.begin(), own.end());
  };
  for (const simulation::Body& body : world.bodies) add(body);
  add(world.car);
  return triangles;
}

simulation::RoadShape random_road(Rng& rng) {
  simulation::RoadShape shape;
  const bool is_straight = rng.uniform() < 0.3;
  const double bend = rng.uniform(-1.0, 1.0);
  shape.curvature_per_m = is_straight ? 0.0 : bend / 120.0;
  shape.half_width_m = rng.uniform(3.0, 14.0);
  shape.grade = rng.uniform(-0.06, 0.06);
  shape.banking = rng.uniform(-0.05, 0.05);
  shape.crown = rng.uniform(0.0, 0.025);
  shape.pavement_width_m = rng.uniform(0.0, 4.0);
  return shape;
}

Vector2d road_coordinates(const simulation::RoadShape& shape, const Vector3d& position) {
  const double curvature_per_m = shape.curvature_per_m;
  if (curvature_per_m == 0.0) return position.head<2>();
  const double sign = curvature_per_m > 0.0 ? 1.0 : -1.0;
  const double radius_m = 1.0 / curvature_per_m;
  const Vector2d spoke = sign * Vector2d(position.x(), radius_m - position.y());
  return {std::atan2(spoke.x(), spoke.y()) * radius_m, radius_m - sign * spoke.norm()};
}

Mesh without_ground(const simulation::World& world, const simulation::RoadShape& shape) {
  Mesh ground;
  simulation::Ground(shape, StreamKey(0)).add_to(ground);
  const auto first = static_cast<std::ptrdiff_t>(ground.vertices.size());
  const auto first_triangle = static_cast<std::ptrdiff_t>(ground.triangles.size());
  Mesh rest;
  rest.vertices.assign(world.fixed.vertices.begin() + first, world.fixed.vertices.end());
  rest.triangles.assign(world.fixed.triangles.begin() + first_triangle,
                        world.fixed.triangles.end());
  rest.materials.assign(world.fixed.materials.begin() + first_triangle,
                        world.fixed.materials.end());
  for (auto& triangle : rest.triangles) {
    for (std::uint32_t& index : triangle) index -= ground.next_vertex();
  }
  return rest;
}

bool is_in_car(const simulation::CarBody& car, const Eigen::Vector3f& point) {
  return std::abs(point.x()) < 0.5 * car.length_m && std::abs(point.y()) < 0.5 * car.width_m;
}

std::vector<Vector2d> positions_in(const Mesh& objects, const simulation::RoadShape& shape,
                                   std::size_t vertices) {
  std::vector<Vector2d> positions;
  for (std::size_t first = 0; first + vertices <= objects.vertices.size(); first += vertices) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = first; i < first + vertices; ++i) {
      sum += objects.vertices[i].cast<double>();
    }
    positions.push_back(road_coordinates(shape, sum / static_cast<double>(vertices)));
  }
  return positions;
}

}  // namespace croon::test
