// The objects of a builder have space of their own, stand on the ground and follow the road.
#include "framework/simulation/scenes/builder.hpp"

#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/shapes.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;
using test::test_rng;

constexpr std::uint64_t kBuilderSeeds = 20;
constexpr CarBody kBuilderCar = {4.7, 1.9};

std::size_t vertices_of_a_bollard() {
  Rng rng = test_rng();
  return make_bollard(rng).vertices.size();
}

RoadPose random_pose(Rng& rng) {
  return {rng.uniform(-25.0, 25.0), rng.uniform(-15.0, 15.0), rng.uniform(-kPi, kPi)};
}

TEST(SceneBuilder, AcceptsAnObjectIfAndOnlyIfItsSpaceIsFree) {
  for (std::uint64_t seed = 1; seed <= kBuilderSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const RoadShape shape = test::random_road(rng);
    SceneBuilder builder(shape, StreamKey(seed));
    Occupancy expected;
    std::size_t accepted_vertices = 0;
    int refused = 0;
    for (int i = 0; i < 60; ++i) {
      const Mesh mesh = make_vehicle(VehicleType::car, rng).mesh;
      const RoadPose pose = random_pose(rng);
      const std::array<RoadBox, 2> boxes = boxes_of(mesh, pose, shape.curvature_per_m);
      const bool is_free = expected.is_free(boxes[0]);
      const bool is_accepted =
          i % 2 == 0 ? builder.place_upright(mesh, pose) : builder.park(mesh, pose);
      ASSERT_EQ(is_accepted, is_free) << "seed " << seed;
      refused += is_free ? 0 : 1;
      if (!is_free) continue;
      expected.occupy(boxes[0]);
      accepted_vertices += mesh.vertices.size();
    }
    EXPECT_GT(refused, 0);
    EXPECT_EQ(test::without_ground(builder.finish(), shape).vertices.size(), accepted_vertices);
  }
}

TEST(SceneBuilder, LetsObjectsStandUnderCrownsAndArms) {
  SceneBuilder builder(RoadShape{}, StreamKey(1));
  Mesh roof;
  add_box(roof, {-2.0, -2.0, 4.0}, {2.0, 2.0, 4.2}, Material::wood);
  Rng rng = test_rng();
  EXPECT_TRUE(builder.place_upright(roof, {0.0, 0.0, 0.0}));
  EXPECT_FALSE(builder.place_upright(roof, {1.0, 1.0, 0.0}));
  EXPECT_TRUE(builder.place_upright(make_bollard(rng), {0.0, 0.0, 0.0}));
}

TEST(SceneBuilder, KeepsTheSpaceOfTheCarClear) {
  for (std::uint64_t seed = 1; seed <= kBuilderSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const RoadShape shape = test::random_road(rng);
    SceneBuilder builder(shape, StreamKey(seed));
    const RoadPose pose = {0.0, rng.uniform(-2.0, 2.0), rng.uniform(-kPi, kPi)};
    builder.put_car(pose, kBuilderCar, rng.uniform(0.0, 20.0));
    for (int i = 0; i < 200; ++i) {
      const double s_m = rng.uniform(-6.0, 6.0);
      const double d_m = pose.d_m + rng.uniform(-6.0, 6.0);
      builder.place_upright(make_bollard(rng), {s_m, d_m, 0.0});
    }
    const World world = builder.finish();
    const Mesh objects = test::without_ground(world, shape);
    ASSERT_FALSE(objects.vertices.empty());
    for (const Eigen::Vector3f& vertex :
         transformed(objects.vertices, world.car.T_world_body.inverse())) {
      ASSERT_FALSE(test::is_in_car(kBuilderCar, vertex)) << "seed " << seed;
    }
  }
}

TEST(SceneBuilder, StandsObjectsOnTheGroundWithoutGaps) {
  for (std::uint64_t seed = 1; seed <= kBuilderSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const RoadShape shape = test::random_road(rng);
    SceneBuilder builder(shape, StreamKey(seed));
    const Ground ground = builder.ground();
    const RoadPose pose = random_pose(rng);
    Mesh plate;
    plate.add_quad(Vector3d(-2.0, -1.0, 0.0), Vector3d(2.0, -1.0, 0.0), Vector3d(2.0, 1.0, 0.0),
                   Vector3d(-2.0, 1.0, 0.0), Material::wood);
    ASSERT_TRUE(builder.place_upright(plate, pose));
    for (const Eigen::Vector3f& vertex : test::without_ground(builder.finish(), shape).vertices) {
      const Eigen::Vector2d road = test::road_coordinates(shape, vertex.cast<double>());
      EXPECT_LE(vertex.z(), shape.height_m(road.x(), road.y()) + 0.03) << "seed " << seed;
      EXPECT_NEAR(vertex.z(), ground.point(pose.s_m, pose.d_m).z(), 0.6) << "seed " << seed;
    }
  }
}

TEST(SceneBuilder, LetsVehiclesFollowTheRoad) {
  for (std::uint64_t seed = 1; seed <= kBuilderSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const RoadShape shape = test::random_road(rng);
    SceneBuilder builder(shape, StreamKey(seed));
    const bool is_back = chance(rng, 0.5);
    const RoadPose pose = {rng.uniform(-50.0, 50.0), rng.uniform(-10.0, 10.0), is_back ? kPi : 0.0};
    const double speed_mps = rng.uniform(1.0, 30.0);
    ASSERT_TRUE(builder.drive(make_vehicle(VehicleType::car, rng).mesh, pose, speed_mps));
    const World world = builder.finish();
    ASSERT_EQ(world.bodies.size(), 1U);
    constexpr double kTime_s = 0.5;
    const Vector3d later = world.bodies[0].pose_at(kTime_s).translation;
    const Eigen::Vector2d road = test::road_coordinates(shape, later);
    const double way_m = (is_back ? -1.0 : 1.0) * speed_mps * kTime_s;
    EXPECT_NEAR(road.y(), pose.d_m, 0.05);
    EXPECT_NEAR(road.x(), pose.s_m + way_m / (1.0 - shape.curvature_per_m * pose.d_m), 0.1);
  }
}

TEST(AddSeries, KeepsItsSpacingAndDistance) {
  for (std::uint64_t seed = 1; seed <= kBuilderSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const RoadShape shape = test::random_road(rng);
    const Series series = {make_bollard, 1, {3.0, 5.0}, {6.0, 7.0}};
    for (const Roadside& side : both_sides()) {
      SceneBuilder builder(shape, StreamKey(seed));
      add_series(builder, side, {-40.0, 40.0}, series, Rng(StreamKey(seed)));
      const auto positions = test::positions_in(test::without_ground(builder.finish(), shape),
                                                shape, vertices_of_a_bollard());
      ASSERT_GE(positions.size(), 15U);
      ASSERT_LE(positions.size(), 27U);
      for (std::size_t i = 0; i < positions.size(); ++i) {
        EXPECT_GE(side.sign * positions[i].y(), 5.95);
        EXPECT_LE(side.sign * positions[i].y(), 7.05);
        EXPECT_GE(positions[i].x(), -40.05);
        EXPECT_LE(positions[i].x(), 40.05);
        if (i == 0) continue;
        EXPECT_GE(positions[i].x() - positions[i - 1].x(), 2.95);
        EXPECT_LE(positions[i].x() - positions[i - 1].x(), 5.05);
      }
    }
  }
}

TEST(AddSeries, FillsItsShareOfThePositions) {
  SceneBuilder builder(RoadShape{}, StreamKey(1));
  const Series series = {make_bollard, 1, {1.0, 1.0}, {6.0, 6.0}, 0.0, false, 0.3};
  add_series(builder, both_sides()[0], {-200.0, 200.0}, series, Rng(StreamKey(1)));
  const Mesh objects = test::without_ground(builder.finish(), RoadShape{});
  const std::size_t count = objects.vertices.size() / vertices_of_a_bollard();
  EXPECT_NEAR(static_cast<double>(count), 120.0, 30.0);
}

TEST(CentredAlongX, MovesTheMiddleToZero) {
  for (std::uint64_t seed = 1; seed <= kBuilderSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const Mesh house = make_house(rng);
    const Eigen::AlignedBox3d before = test::bounds_of(house);
    const Eigen::AlignedBox3d after = test::bounds_of(centred_along_x(house));
    EXPECT_NEAR(after.center().x(), 0.0, 1e-5);
    EXPECT_NEAR(after.sizes().x(), before.sizes().x(), 1e-4);
    EXPECT_EQ(after.min().y(), before.min().y());
  }
}

}  // namespace
}  // namespace croon::simulation
