// Houses and halls keep to their ground, are shut, and have windows that lie behind their fronts.
#include <gtest/gtest.h>

#include "framework/simulation/objects/objects.hpp"
#include "test/support/mesh_checks.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using test::bounds_of;
using test::caster_of;
using test::test_rng;

constexpr std::uint64_t kBuildingSeeds = 100;
constexpr double kBuildingEpsilon_m = 1e-4;
constexpr double kLeastFloor_m = 2.5;

/// Widths as in scenes and three times as large, and up to ten floors.
BuildingSize draw_size(Rng& rng, std::uint64_t seed) {
  const double scale = seed % 2 == 0 ? 1.0 : 3.0;
  BuildingSize size;
  size.width_m = scale * rng.uniform(9.0, 22.0);
  size.depth_m = scale * rng.uniform(9.0, 14.0);
  size.floors = 1 + static_cast<int>(rng.below(10));
  return size;
}

/// Expects that no level or upward ray leaves from `inside`.
void expect_closed(const Mesh& mesh, const Vector3d& inside, Rng& rng) {
  std::vector<Ray> rays;
  for (int i = 0; i < 500; ++i) {
    Vector3d direction = test::random_pose(rng, 1.0).rotation.col(0);
    direction.z() = std::abs(direction.z());
    rays.push_back({inside, direction, 0.0});
  }
  for (const Hit& hit : caster_of(mesh)->cast(rays, 0.0, 200.0)) ASSERT_TRUE(hit.is_there());
}

Mesh make_some_building(Rng& rng) { return make_building({15.0, 10.0, 3}, rng); }
Mesh make_some_hall(Rng& rng) { return make_hall({50.0, 30.0, 2}, rng); }

TEST(Buildings, AreDrawnFromTheirGeneratorAlone) {
  test::expect_drawn_from_its_rng(make_some_building);
  test::expect_drawn_from_its_rng(make_house);
  test::expect_drawn_from_its_rng(make_some_hall);
}

TEST(Building, IsSoundAndKeepsToItsGround) {
  for (std::uint64_t seed = 1; seed <= kBuildingSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const BuildingSize size = draw_size(rng, seed);
    const Mesh mesh = make_building(size, rng);
    test::expect_sound(mesh, 2500);
    const AlignedBox3d bounds = bounds_of(mesh);
    EXPECT_NEAR(bounds.min().x(), 0.0, kBuildingEpsilon_m);
    EXPECT_NEAR(bounds.max().x(), size.width_m, kBuildingEpsilon_m);
    EXPECT_GE(bounds.min().y(), -1.6);
    EXPECT_LE(bounds.max().y(), size.depth_m + 0.6);
    EXPECT_NEAR(bounds.min().z(), -1.0, kBuildingEpsilon_m);
    EXPECT_GE(bounds.max().z(), size.floors * kLeastFloor_m);
  }
}

TEST(Building, IsClosed) {
  for (std::uint64_t seed = 1; seed <= kBuildingSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const BuildingSize size = draw_size(rng, seed);
    const Mesh mesh = make_building(size, rng);
    expect_closed(mesh, {0.5 * size.width_m, 0.5 * size.depth_m, 1.5}, rng);
  }
}

TEST(Building, HasPanesBehindItsFront) {
  constexpr double kBefore_m = 30.0;
  for (std::uint64_t seed = 1; seed <= kBuildingSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const BuildingSize size = draw_size(rng, seed);
    const auto caster = caster_of(make_building(size, rng));
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; ++i) {
      const double x_m = rng.uniform(0.0, size.width_m);
      const double z_m = rng.uniform(0.0, size.floors * kLeastFloor_m);
      rays.push_back({{x_m, -kBefore_m, z_m}, Vector3d::UnitY(), 0.0});
    }
    int panes = 0;
    for (const Hit& hit : caster->cast(rays, 0.0, 100.0)) {
      if (hit.material != Material::glass) continue;
      ++panes;
      // A bay stands out by 0.7 m.
      EXPECT_GT(hit.range_m, kBefore_m - 0.61);
    }
    EXPECT_GT(panes, 100) << "seed " << seed;
    EXPECT_LT(panes, 1800) << "seed " << seed;
  }
}

TEST(House, IsSoundAndClosedAndKeepsToItsGround) {
  for (std::uint64_t seed = 1; seed <= kBuildingSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const Mesh mesh = make_house(rng);
    test::expect_sound(mesh, 800);
    const AlignedBox3d bounds = bounds_of(mesh);
    EXPECT_GE(bounds.min().x(), -1.0);
    EXPECT_LE(bounds.max().x(), 14.0 + 3.5);
    EXPECT_GE(bounds.min().y(), -1.6);
    EXPECT_NEAR(bounds.min().z(), -1.0, kBuildingEpsilon_m);
    EXPECT_GE(bounds.max().z(), 5.0);
    EXPECT_LE(bounds.max().z(), 15.0);
    expect_closed(mesh, {4.0, 3.0, 1.5}, rng);
  }
}

TEST(Hall, IsSoundAndClosedAndKeepsToItsGround) {
  for (std::uint64_t seed = 1; seed <= kBuildingSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    BuildingSize size;
    size.width_m = rng.uniform(20.0, 100.0);
    size.depth_m = rng.uniform(15.0, 50.0);
    size.floors = 1 + static_cast<int>(rng.below(3));
    const Mesh mesh = make_hall(size, rng);
    test::expect_sound(mesh, 600);
    const AlignedBox3d bounds = bounds_of(mesh);
    const AlignedBox3d allowed(Vector3d(-0.3, -0.3, -1.0 - kBuildingEpsilon_m),
                               Vector3d(size.width_m + 0.3, size.depth_m + 0.3, 15.0));
    EXPECT_TRUE(allowed.contains(bounds));
    EXPECT_NEAR(bounds.min().z(), -1.0, kBuildingEpsilon_m);
    expect_closed(mesh, {0.5 * size.width_m, 0.5 * size.depth_m, 1.5}, rng);
  }
}

}  // namespace
}  // namespace croon::simulation
