// Tunnels and bridges leave the carriageway free, however the road bends and leans, and are shut.
#include "framework/simulation/objects/structures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "test/framework/simulation/objects/mesh_checks.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::simulation {
namespace {

using croon::test::test_rng;
using Eigen::Vector2d;
using Eigen::Vector3d;
using test::caster_of;

constexpr std::uint64_t kSeeds = 60;
constexpr double kClear_m = 4.7;
constexpr double kEpsilon_m = 0.02;

Ground draw_ground(Rng& rng, std::uint64_t seed) {
  RoadShape shape;
  shape.curvature_per_m = seed % 3 == 0 ? 0.0 : rng.uniform(-1.0, 1.0) / 120.0;
  shape.half_width_m = rng.uniform(3.0, 14.0);
  shape.grade = rng.uniform(-0.06, 0.06);
  shape.banking = rng.uniform(-0.05, 0.05);
  shape.crown = rng.uniform(0.0, 0.025);
  shape.pavement_width_m = rng.uniform(0.0, 4.0);
  return {shape, StreamKey(seed)};
}

Stretch draw_stretch(Rng& rng, double least_m, double most_m) {
  const double from_m = rng.uniform(-60.0, 60.0);
  return {from_m, from_m + rng.uniform(least_m, most_m)};
}

/// Road coordinates (s, d) of a place in the world.
Vector2d road_coordinates(const Ground& ground, const Vector3d& place) {
  const double curvature_per_m = ground.shape().curvature_per_m;
  if (curvature_per_m == 0.0) return place.head<2>();
  const double sign = curvature_per_m > 0.0 ? 1.0 : -1.0;
  const double radius_m = 1.0 / curvature_per_m;
  const Vector2d spoke = sign * Vector2d(place.x(), radius_m - place.y());
  return {std::atan2(spoke.x(), spoke.y()) * radius_m, radius_m - sign * spoke.norm()};
}

/// Expects nothing of `mesh` in the carriageway up to 4.7 m above its surface.
void expect_free_carriageway(const Mesh& mesh, const Ground& ground, const Stretch& stretch,
                             Rng& rng) {
  const double kerb_m = ground.shape().half_width_m;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    const Vector3d place = vertex.cast<double>();
    const Vector2d road = road_coordinates(ground, place);
    if (std::abs(road.y()) >= kerb_m) continue;
    ASSERT_GE(place.z(), ground.height_m(road.x(), road.y()) + kClear_m) << road.transpose();
  }
  std::vector<Ray> rays;
  for (int i = 0; i < 1000; ++i) {
    const double s_m = rng.uniform(stretch.from_s_m, stretch.to_s_m);
    const double d_m = rng.uniform(-kerb_m, kerb_m);
    rays.push_back({ground.point(s_m, d_m), Vector3d::UnitZ(), 0.0});
  }
  for (const Hit& hit : caster_of(mesh)->cast(rays, 0.0, 50.0)) {
    ASSERT_TRUE(hit.is_there());
    ASSERT_GE(hit.range_m, kClear_m - kEpsilon_m);
    ASSERT_LE(hit.range_m, 9.0);
  }
}

/// The hits of level rays to both sides from 1.2 m above the road's middle, anywhere in `stretch`.
std::vector<Hit> hits_aside(const Mesh& mesh, const Ground& ground, const Stretch& stretch,
                            Rng& rng) {
  std::vector<Ray> rays;
  for (int i = 0; i < 1000; ++i) {
    const double s_m = rng.uniform(stretch.from_s_m, stretch.to_s_m);
    const double yaw_rad = ground.heading_rad(s_m) + (i % 2 == 0 ? 0.5 : -0.5) * kPi;
    const Vector3d aside(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
    rays.push_back({ground.point(s_m, 0.0, 1.2), aside, 0.0});
  }
  return caster_of(mesh)->cast(rays, 0.0, 100.0);
}

TEST(Structures, AreDrawnFromTheirGeneratorAlone) {
  const Ground ground(RoadShape{}, StreamKey(1));
  test::expect_drawn_from_its_rng([&](Rng& rng) { return make_tunnel(ground, {10.0, 60.0}, rng); });
  test::expect_drawn_from_its_rng([&](Rng& rng) { return make_bridge(ground, {10.0, 20.0}, rng); });
}

TEST(Tunnel, IsSoundAndLeavesTheCarriagewayFree) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const Ground ground = draw_ground(rng, seed);
    const Stretch stretch = draw_stretch(rng, 20.0, 130.0);
    const Mesh mesh = make_tunnel(ground, stretch, rng);
    test::expect_sound(mesh, 3000);
    expect_free_carriageway(mesh, ground, stretch, rng);
  }
}

TEST(Tunnel, HasWallsBehindTheKerbsOnBothSides) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const Ground ground = draw_ground(rng, seed);
    const Stretch stretch = draw_stretch(rng, 20.0, 130.0);
    const double kerb_m = ground.shape().half_width_m;
    for (const Hit& hit : hits_aside(make_tunnel(ground, stretch, rng), ground, stretch, rng)) {
      ASSERT_GE(hit.range_m, kerb_m + 0.3);
      ASSERT_LE(hit.range_m, kerb_m + 4.5);
    }
  }
}

TEST(Bridge, IsSoundAndLeavesTheCarriagewayFree) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const Ground ground = draw_ground(rng, seed);
    const Stretch stretch = draw_stretch(rng, 6.0, 20.0);
    const Mesh mesh = make_bridge(ground, stretch, rng);
    test::expect_sound(mesh, 1800);
    expect_free_carriageway(mesh, ground, stretch, rng);
  }
}

TEST(Bridge, HasAbutmentsBehindTheKerbsOnBothSides) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const Ground ground = draw_ground(rng, seed);
    const Stretch stretch = draw_stretch(rng, 6.0, 20.0);
    const double kerb_m = ground.shape().half_width_m;
    for (const Hit& hit : hits_aside(make_bridge(ground, stretch, rng), ground, stretch, rng)) {
      ASSERT_GE(hit.range_m, kerb_m + 0.9);
      ASSERT_LE(hit.range_m, kerb_m + 16.0);
    }
  }
}

}  // namespace
}  // namespace croon::simulation
