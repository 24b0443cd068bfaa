// Parked cars, people and furniture keep to their strips beside the road.
#include "framework/simulation/scenes/kerbside.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "framework/simulation/objects/objects.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using test::road_coordinates;
using test::test_rng;

constexpr std::uint64_t kKerbSeeds = 20;

/// The distances (along, out) on `side` of the vertices lower than `below_m` above the ground.
std::vector<Vector2d> low_vertices(const Mesh& mesh, const RoadShape& shape, const Roadside& side,
                                   double below_m) {
  std::vector<Vector2d> result;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    const Vector2d road = road_coordinates(shape, vertex.cast<double>());
    if (static_cast<double>(vertex.z()) > shape.height_m(road.x(), road.y()) + below_m) continue;
    result.emplace_back(road.x(), side.sign * road.y());
  }
  return result;
}

TEST(AddParkedRow, StaysInItsStripAndRange) {
  for (std::uint64_t seed = 1; seed <= kKerbSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const RoadShape shape = test::random_road(rng);
    const double middle_m = shape.half_width_m - 1.1;
    for (const Roadside& side : both_sides()) {
      SceneBuilder builder(shape, StreamKey(seed));
      add_parked_row(builder, side, {-40.0, 40.0}, middle_m, 0.8, Rng(StreamKey(seed)));
      const Mesh cars = test::without_ground(builder.finish(), shape);
      ASSERT_FALSE(cars.vertices.empty());
      // Tyres stay off the kerb, mirrors may reach over it.
      for (const Vector2d& vertex : low_vertices(cars, shape, side, 0.4)) {
        ASSERT_LE(vertex.y(), shape.half_width_m + 0.25);
        ASSERT_GE(vertex.y(), middle_m - 1.6);
        ASSERT_GE(vertex.x(), -41.0);
        ASSERT_LE(vertex.x(), 42.0);
      }
    }
  }
}

TEST(AddParkedRow, HasGapsBetweenItsCars) {
  SceneBuilder builder(RoadShape{}, StreamKey(1));
  const Roadside side = both_sides()[0];
  add_parked_row(builder, side, {-100.0, 100.0}, 5.0, 1.0, Rng(StreamKey(1)));
  std::vector<double> positions_m;
  for (const Eigen::Vector3f& vertex :
       test::without_ground(builder.finish(), RoadShape{}).vertices) {
    positions_m.push_back(static_cast<double>(vertex.x()));
  }
  std::sort(positions_m.begin(), positions_m.end());
  // All parking spaces are taken: no hole of the length of a car, but gaps of half a metre and
  // more.
  int gaps = 0;
  for (std::size_t i = 1; i < positions_m.size(); ++i) {
    const double gap_m = positions_m[i] - positions_m[i - 1];
    EXPECT_LT(gap_m, 3.0);
    gaps += gap_m > 0.45 ? 1 : 0;
  }
  EXPECT_GE(gaps, 28);
}

TEST(AddPeople, AreBetweenTheirDistances) {
  for (std::uint64_t seed = 1; seed <= kKerbSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const RoadShape shape = test::random_road(rng);
    const Span out_m = {shape.half_width_m + 1.0, shape.half_width_m + 3.0};
    for (const Roadside& side : both_sides()) {
      SceneBuilder builder(shape, StreamKey(seed));
      add_people(builder, side, {-40.0, 40.0}, out_m, 30, Rng(StreamKey(seed)));
      const World world = builder.finish();
      EXPECT_GE(world.bodies.size(), 5U);
      EXPECT_LE(world.bodies.size(), 30U);
      for (const Body& body : world.bodies) {
        const Vector2d road = road_coordinates(shape, body.T_world_body.translation);
        EXPECT_GE(side.sign * road.y(), out_m.from - 0.05);
        EXPECT_LE(side.sign * road.y(), out_m.to + 0.05);
        EXPECT_NEAR(body.motion.speed_mps, 1.25, 0.5);
      }
      const Mesh standing = test::without_ground(world, shape);
      EXPECT_FALSE(standing.vertices.empty());
      for (const Vector2d& vertex : low_vertices(standing, shape, side, 3.0)) {
        ASSERT_GE(vertex.y(), out_m.from - 1.0);
        ASSERT_LE(vertex.y(), out_m.to + 1.0);
      }
    }
  }
}

TEST(AddFurniture, KeepsOffTheCarriageway) {
  for (std::uint64_t seed = 1; seed <= kKerbSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    RoadShape shape = test::random_road(rng);
    shape.pavement_width_m = rng.uniform(2.8, 5.0);
    const Pavement pavement = {shape.half_width_m, shape.pavement_width_m, 0.0};
    for (const Roadside& side : both_sides()) {
      SceneBuilder builder(shape, StreamKey(seed));
      add_furniture(builder, side, {-60.0, 60.0}, pavement, StreamKey(seed));
      const Mesh furniture = test::without_ground(builder.finish(), shape);
      ASSERT_FALSE(furniture.vertices.empty());
      // Arms of lamps reach over the carriageway, far above vehicles.
      for (const Vector2d& vertex : low_vertices(furniture, shape, side, 4.0)) {
        ASSERT_GT(vertex.y(), shape.half_width_m - 0.1);
        ASSERT_LT(vertex.y(), shape.half_width_m + pavement.width_m + 1.0);
      }
    }
  }
}

TEST(AddFurniture, HasTreesBySharesAndDetailsNearTheCarOnly) {
  const auto vertices = [](double tree_share, const Span& along_m) {
    SceneBuilder builder(RoadShape{}, StreamKey(3));
    add_furniture(builder, both_sides()[0], along_m, {4.0, 3.5, tree_share}, StreamKey(3));
    const Mesh mesh = test::without_ground(builder.finish(), RoadShape{});
    return static_cast<double>(
        std::count(mesh.materials.begin(), mesh.materials.end(), Material::leaf));
  };
  EXPECT_EQ(vertices(0.0, {-100.0, 100.0}), 0.0);
  EXPECT_GT(vertices(0.9, {-100.0, 100.0}), 1.5 * vertices(0.4, {-100.0, 100.0}));
  // Signs and bins stand near the car; lamps and trees are the rest.
  SceneBuilder builder(RoadShape{}, StreamKey(3));
  add_furniture(builder, both_sides()[0], {200.0, 400.0}, {4.0, 3.5, 0.0}, StreamKey(3));
  const Mesh far_away = test::without_ground(builder.finish(), RoadShape{});
  EXPECT_EQ(std::count(far_away.materials.begin(), far_away.materials.end(), Material::sign), 0);
  EXPECT_GT(far_away.triangles.size(), 0U);
}

}  // namespace
}  // namespace croon::simulation
