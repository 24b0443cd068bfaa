// Rows of houses and plots keep to their side of the road and to their rows.
#include "framework/simulation/scenes/houses.hpp"

#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "test/support/mesh_checks.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::test_rng;

constexpr std::uint64_t kHouseSeeds = 12;

/// A straight or slightly bent road with a free side.
RoadShape random_street(Rng& rng) {
  RoadShape shape = test::random_road(rng);
  shape.half_width_m = rng.uniform(4.0, 8.0);
  return shape;
}

/// The distances (along, out) on `side` of all vertices.
std::vector<Vector2d> vertices_of(const Mesh& mesh, const RoadShape& shape, const Roadside& side) {
  std::vector<Vector2d> result;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    const Vector2d road = test::road_coordinates(shape, vertex.cast<double>());
    result.emplace_back(road.x(), side.sign * road.y());
  }
  return result;
}

TEST(AddFronts, StandBehindTheirLineAndInsideTheirRowNearTheCar) {
  for (std::uint64_t seed = 1; seed <= kHouseSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const RoadShape shape = random_street(rng);
    Fronts fronts;
    fronts.out_m = shape.half_width_m + 5.0;
    const Span along_m = {-rng.uniform(20.0, 50.0), rng.uniform(20.0, 50.0)};
    for (const Roadside& side : both_sides()) {
      SceneBuilder builder(shape, StreamKey(seed));
      add_fronts(builder, side, along_m, fronts, Rng(StreamKey(seed)));
      const Mesh houses = test::without_ground(builder.finish(), shape);
      ASSERT_FALSE(houses.vertices.empty());
      for (const Vector2d& vertex : vertices_of(houses, shape, side)) {
        // Balconies, steps and roofs reach out by up to 1.6 m; on the outside of a bend the corners
        // of straight fronts are nearer.
        ASSERT_GE(vertex.y(), fronts.out_m - 2.2);
        ASSERT_LE(vertex.y(), fronts.out_m + 20.0);
        ASSERT_GE(vertex.x(), along_m.from - 1.5);
        ASSERT_LE(vertex.x(), along_m.to + 1.5);
      }
    }
  }
}

TEST(AddFronts, CloseTheViewByTheirShareOfHouses) {
  // Rays to the side meet a house or a gap.
  const auto closed_share = [](double wall_to_wall, double side_street) {
    Fronts fronts;
    fronts.wall_to_wall = wall_to_wall;
    fronts.side_street = side_street;
    int closed = 0;
    int all = 0;
    for (std::uint64_t seed = 1; seed <= kHouseSeeds; ++seed) {
      SceneBuilder builder(RoadShape{}, StreamKey(seed));
      add_fronts(builder, both_sides()[0], {-55.0, 55.0}, fronts, Rng(StreamKey(seed)));
      const Mesh houses = test::without_ground(builder.finish(), RoadShape{});
      std::vector<Ray> rays;
      for (double s_m = -50.0; s_m <= 40.0; s_m += 0.25) {
        rays.push_back({{s_m, 0.0, 4.0}, Vector3d::UnitY(), 0.0});
      }
      for (const Hit& hit : test::caster_of(houses)->cast(rays, 0.0, 40.0)) {
        closed += hit.is_there() ? 1 : 0;
        ++all;
      }
    }
    return static_cast<double>(closed) / all;
  };
  EXPECT_GT(closed_share(1.0, 0.0), 0.97);
  EXPECT_LT(closed_share(0.0, 1.0), 0.75);
}

TEST(AddFronts, HaveDetailsNearTheCarOnly) {
  for (std::uint64_t seed = 1; seed <= kHouseSeeds; ++seed) {
    SceneBuilder builder(RoadShape{}, StreamKey(seed));
    add_fronts(builder, both_sides()[0], {kDetail_m + 30.0, 200.0}, {}, Rng(StreamKey(seed)));
    const Mesh blocks = test::without_ground(builder.finish(), RoadShape{});
    ASSERT_FALSE(blocks.triangles.empty());
    // Plain blocks of twelve triangles.
    EXPECT_EQ(blocks.triangles.size() % 12, 0U);
    EXPECT_LE(blocks.triangles.size(), 12U * 12U);
  }
}

TEST(AddBackdrop, StandsBetweenItsDistances) {
  for (std::uint64_t seed = 1; seed <= kHouseSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const RoadShape shape = random_street(rng);
    const Span out_m = {40.0, 65.0};
    for (const Roadside& side : both_sides()) {
      SceneBuilder builder(shape, StreamKey(seed));
      add_backdrop(builder, side, {-100.0, 100.0}, out_m, Rng(StreamKey(seed)));
      const Mesh blocks = test::without_ground(builder.finish(), shape);
      ASSERT_FALSE(blocks.vertices.empty());
      for (const Vector2d& vertex : vertices_of(blocks, shape, side)) {
        ASSERT_GE(vertex.y(), out_m.from - 2.0);
        ASSERT_LE(vertex.y(), out_m.to + 16.0);
      }
    }
  }
}

/// `mesh` without plants.
Mesh without_leaves(const Mesh& mesh) {
  Mesh result;
  result.vertices = mesh.vertices;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Material material = mesh.materials[i];
    if (material == Material::leaf || material == Material::bark) continue;
    result.add_triangle(a, b, c, material);
  }
  return result;
}

TEST(AddPlots, LeaveThePavementFree) {
  for (std::uint64_t seed = 1; seed <= kHouseSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const RoadShape shape = random_street(rng);
    const double out_m = shape.half_width_m + 3.0;
    for (const Roadside& side : both_sides()) {
      SceneBuilder builder(shape, StreamKey(seed));
      add_plots(builder, side, {-100.0, 100.0}, out_m, StreamKey(seed));
      const Mesh plots = test::without_ground(builder.finish(), shape);
      ASSERT_FALSE(plots.vertices.empty());
      // Crowns of trees may hang over the pavement.
      for (const test::Triangle& triangle : test::triangles_of(without_leaves(plots))) {
        for (const Vector3d& vertex : triangle) {
          const Vector2d road = test::road_coordinates(shape, vertex);
          ASSERT_GE(side.sign * road.y(), out_m - 0.5);
        }
      }
    }
  }
}

TEST(AddPlots, AreSideBySideWithOneHouseEach) {
  for (std::uint64_t seed = 1; seed <= kHouseSeeds; ++seed) {
    SCOPED_TRACE(seed);
    SceneBuilder builder(RoadShape{}, StreamKey(seed));
    add_plots(builder, both_sides()[0], {-50.0, 50.0}, 8.0, StreamKey(seed));
    const Mesh plots = test::without_ground(builder.finish(), RoadShape{});
    // Level rays from the road, 2 m above the ground, meet walls of houses and the gaps between
    // them: plots are 17 to 27 m wide, so there are four to six houses.
    std::vector<Ray> rays;
    for (double s_m = -55.0; s_m <= 80.0; s_m += 0.1) {
      rays.push_back({{s_m, 0.0, 2.5}, Vector3d::UnitY(), 0.0});
    }
    int houses = 0;
    int gap = 100;
    for (const Hit& hit :
         test::caster_of(without_leaves(plots))->cast(rays, 0.0, 8.0 + 9.0 + 12.0)) {
      const bool is_house = hit.is_there() && hit.range_m > 8.0 + 3.5;
      if (is_house && gap >= 10) ++houses;
      gap = is_house ? 0 : gap + 1;
    }
    EXPECT_GE(houses, 4);
    EXPECT_LE(houses, 7);
  }
}

TEST(AddPlots, FollowFromTheirKey) {
  const auto made = [](std::uint64_t seed) {
    SceneBuilder builder(RoadShape{}, StreamKey(1));
    add_plots(builder, both_sides()[0], {-60.0, 60.0}, 8.0, StreamKey(seed));
    return builder.finish().fixed;
  };
  EXPECT_TRUE(test::are_same(made(1), made(1)));
  EXPECT_FALSE(test::are_same(made(1), made(2)));
}

TEST(MakeBlock, HasTheSizeThatIsAskedFor) {
  Rng rng = test_rng();
  const Eigen::AlignedBox3d bounds = test::bounds_of(make_block({20.0, 10.0, 3}, rng));
  EXPECT_TRUE(bounds.isApprox(
      Eigen::AlignedBox3d(Vector3d(0.0, 0.0, -1.0), Vector3d(20.0, 10.0, 9.0)), 1e-6));
}

}  // namespace
}  // namespace croon::simulation
