// Tunnels and bridges leave the carriageway free, however the road bends and leans, and are shut.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/objects.hpp"
#include "test/support/mesh_checks.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::caster_of;
using test::test_rng;

constexpr std::uint64_t kStructureSeeds = 60;
constexpr double kClear_m = 4.7;
constexpr double kStructureEpsilon_m = 0.02;

/// Expects nothing of `mesh` in the carriageway up to 4.7 m above its surface.
void expect_free_carriageway(const Mesh& mesh, const Ground& ground, const Span& along_m,
                             Rng& rng) {
  const double kerb_m = ground.shape().half_width_m;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    const Vector3d position = vertex.cast<double>();
    const Vector2d road = test::road_coordinates(ground.shape(), position);
    if (std::abs(road.y()) >= kerb_m) continue;
    ASSERT_GE(position.z(), ground.shape().height_m(road.x(), road.y()) + kClear_m)
        << road.transpose();
  }
  std::vector<Ray> rays;
  for (int i = 0; i < 1000; ++i) {
    const double s_m = rng.uniform(along_m.from, along_m.to);
    const double d_m = rng.uniform(-kerb_m, kerb_m);
    rays.push_back({ground.point(s_m, d_m), Vector3d::UnitZ(), 0.0});
  }
  for (const Hit& hit : caster_of(mesh)->cast(rays, 0.0, 50.0)) {
    ASSERT_TRUE(hit.is_there());
    ASSERT_GE(hit.range_m, kClear_m - kStructureEpsilon_m);
    ASSERT_LE(hit.range_m, 9.0);
  }
}

/// The hits of level rays to both sides from 1.2 m above the road's middle, anywhere in `along_m`.
std::vector<Hit> hits_aside(const Mesh& mesh, const Ground& ground, const Span& along_m, Rng& rng) {
  std::vector<Ray> rays;
  for (int i = 0; i < 1000; ++i) {
    const double s_m = rng.uniform(along_m.from, along_m.to);
    const double yaw_rad = ground.heading_rad(s_m) + (i % 2 == 0 ? 0.5 : -0.5) * kPi;
    const Vector3d aside(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
    rays.push_back({ground.point(s_m, 0.0, 1.2), aside, 0.0});
  }
  return caster_of(mesh)->cast(rays, 0.0, 100.0);
}

/// A structure over the road and its documented dimensions.
struct Structure {
  const char* name;
  Mesh (*make)(const Ground& ground, const Span& along_m, Rng& rng);
  Span length_m;
  std::size_t most_triangles;
  Span behind_kerb_m;  ///< Positions of its walls.
};

class StructureTest : public testing::TestWithParam<Structure> {};

TEST_P(StructureTest, IsDrawnFromItsGeneratorAlone) {
  const Ground ground(RoadShape{}, StreamKey(1));
  test::expect_drawn_from_its_rng([&](Rng& rng) {
    return GetParam().make(ground, {10.0, 30.0}, rng);
  });
}

TEST_P(StructureTest, IsSoundAndLeavesTheCarriagewayFreeBetweenItsWalls) {
  for (std::uint64_t seed = 1; seed <= kStructureSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const Ground ground(test::random_road(rng), StreamKey(seed));
    const double from_m = rng.uniform(-60.0, 60.0);
    const Span along_m = {from_m, from_m + draw(rng, GetParam().length_m)};
    const Mesh mesh = GetParam().make(ground, along_m, rng);
    test::expect_sound(mesh, GetParam().most_triangles);
    expect_free_carriageway(mesh, ground, along_m, rng);
    const double kerb_m = ground.shape().half_width_m;
    for (const Hit& hit : hits_aside(mesh, ground, along_m, rng)) {
      ASSERT_GE(hit.range_m, kerb_m + GetParam().behind_kerb_m.from);
      ASSERT_LE(hit.range_m, kerb_m + GetParam().behind_kerb_m.to);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Simulation, StructureTest,
    testing::Values(Structure{"tunnel", make_tunnel, {20.0, 130.0}, 3000, {0.3, 4.5}},
                    Structure{"bridge", make_bridge, {6.0, 20.0}, 1800, {0.9, 16.0}}),
    [](const auto& structure) { return structure.param.name; });

}  // namespace
}  // namespace croon::simulation
