// Boxes in road coordinates hold the objects that they stand for, and sides of roads are mirrored.
#include "framework/simulation/scenes/road_coordinates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/objects.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;
using test::test_rng;

constexpr std::uint64_t kRoadSeeds = 40;

RoadPose random_road_pose(Rng& rng) {
  return {rng.uniform(-80.0, 80.0), rng.uniform(-40.0, 40.0), rng.uniform(-kPi, kPi)};
}

RoadBox random_box(Rng& rng) {
  const double s_m = rng.uniform(-10.0, 10.0);
  const double d_m = rng.uniform(-10.0, 10.0);
  const double length_m = rng.uniform(0.1, 6.0);
  const double width_m = rng.uniform(0.1, 6.0);
  return road_box({s_m, s_m + length_m}, {d_m, d_m + width_m}, rng.uniform(0.5, 5.0));
}

TEST(BoxesOf, HoldTheObjectHoweverTheRoadBends) {
  constexpr double kEpsilon_m = 0.05;  // The bulge of a long side is an approximation.
  for (std::uint64_t seed = 1; seed <= kRoadSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    RoadShape shape;
    shape.curvature_per_m = rng.uniform(-1.0, 1.0) / 120.0;
    const Ground ground(shape, StreamKey(seed));
    const RoadPose pose = random_road_pose(rng);
    const Mesh mesh = seed % 2 == 0 ? make_vehicle(VehicleType::truck, rng).mesh : make_tree(rng);
    const std::array<RoadBox, 2> boxes = boxes_of(mesh, pose, shape.curvature_per_m);
    const RigidTransform T = ground.upright(pose.s_m, pose.d_m, pose.yaw_rad);
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
      const Eigen::Vector2d road = test::road_coordinates(shape, T * vertex.cast<double>());
      const RoadBox& box = boxes[static_cast<double>(vertex.z()) < kHeadroom_m ? 0 : 1];
      ASSERT_GE(road.x(), box.min().x() - kEpsilon_m);
      ASSERT_LE(road.x(), box.max().x() + kEpsilon_m);
      ASSERT_GE(road.y(), box.min().y() - kEpsilon_m);
      ASSERT_LE(road.y(), box.max().y() + kEpsilon_m);
    }
  }
}

TEST(BoxesOf, AreNotMuchLargerThanTheObjectOnAStraightRoad) {
  for (std::uint64_t seed = 1; seed <= kRoadSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const Vehicle vehicle = make_vehicle(VehicleType::car, rng);
    RoadPose pose = random_road_pose(rng);
    pose.yaw_rad = 0.0;
    const std::array<RoadBox, 2> boxes = boxes_of(vehicle.mesh, pose, 0.0);
    EXPECT_TRUE(boxes[1].isEmpty());
    EXPECT_LE(boxes[0].sizes().x(), vehicle.size_m.x() + 1e-6);
    EXPECT_LE(boxes[0].sizes().y(), vehicle.size_m.y() + 1e-6);
  }
}

TEST(Occupancy, IsFreeWhereNoTakenBoxOverlaps) {
  for (std::uint64_t seed = 1; seed <= kRoadSeeds; ++seed) {
    Rng rng = test_rng(seed);
    Occupancy occupancy;
    std::vector<RoadBox> taken;
    int refused = 0;
    for (int i = 0; i < 50; ++i) {
      const RoadBox box = random_box(rng);
      bool overlaps = false;
      for (const RoadBox& other : taken) overlaps |= !box.intersection(other).isEmpty();
      ASSERT_EQ(occupancy.is_free(box), !overlaps) << "seed " << seed;
      refused += overlaps ? 1 : 0;
      if (overlaps) continue;
      occupancy.occupy(box);
      taken.push_back(box);
    }
    EXPECT_GT(refused, 0);
    EXPECT_GT(taken.size(), 3U);
  }
}

TEST(Occupancy, LetsBoxesTouch) {
  Occupancy occupancy;
  occupancy.occupy(road_box({0.0, 1.0}, {0.0, 1.0}, 2.0));
  EXPECT_TRUE(occupancy.is_free(road_box({1.0, 2.0}, {0.0, 1.0}, 2.0)));
  EXPECT_FALSE(occupancy.is_free(road_box({0.99, 2.0}, {0.0, 1.0}, 2.0)));
}

TEST(Roadside, TurnsObjectsAwayFromTheRoad) {
  Rng rng = test_rng();
  for (const bool is_across : {false, true}) {
    for (const double sign : {1.0, -1.0}) {
      const Roadside side = {sign, is_across, 12.0};
      const double along_m = rng.uniform(-50.0, 50.0);
      const double out_m = rng.uniform(3.0, 20.0);
      const RoadPose pose = side.at(along_m, out_m);
      const Eigen::Vector2d away(-std::sin(pose.yaw_rad), std::cos(pose.yaw_rad));
      const RoadPose farther = side.at(along_m, out_m + 1.0);
      EXPECT_NEAR(farther.s_m - pose.s_m, away.x(), 1e-12);
      EXPECT_NEAR(farther.d_m - pose.d_m, away.y(), 1e-12);
      EXPECT_NEAR(is_across ? pose.s_m - 12.0 : pose.d_m, sign * out_m, 1e-12);
      EXPECT_NEAR(is_across ? pose.d_m : pose.s_m, along_m, 1e-12);
      const RoadPose to_road = side.at(along_m, out_m, kToRoad_rad);
      EXPECT_NEAR(std::cos(to_road.yaw_rad), -away.x(), 1e-12);
      EXPECT_NEAR(std::sin(to_road.yaw_rad), -away.y(), 1e-12);
    }
  }
}

TEST(Roadside, HasTheTrafficOfTheRightHandSide) {
  for (const Roadside& side : both_sides()) {
    const RoadPose pose = side.at(0.0, 3.0, kWithTraffic_rad);
    // Vehicles on the right, at negative d, drive along the road.
    EXPECT_NEAR(std::cos(pose.yaw_rad), -side.sign, 1e-12);
  }
}

TEST(Roadside, HasBoxesBetweenItsPoses) {
  Rng rng = test_rng();
  for (int i = 0; i < 100; ++i) {
    const Roadside side = {draw_sign(rng), chance(rng, 0.5), rng.uniform(-20.0, 20.0)};
    const Span along_m = {-rng.uniform(0.0, 30.0), rng.uniform(1.0, 30.0)};
    const Span out_m = {rng.uniform(1.0, 5.0), rng.uniform(6.0, 20.0)};
    const RoadBox box = side.box(along_m, out_m, 2.0);
    EXPECT_NEAR(box.volume(), along_m.length() * out_m.length() * 2.0, 1e-6);
    const double s_m = draw(rng, along_m);
    const RoadPose inside = side.at(s_m, draw(rng, out_m));
    EXPECT_TRUE(box.contains(Vector3d(inside.s_m, inside.d_m, 1.0)));
  }
}

TEST(Roadside, NeedsMoreLengthOnTheInsideOfABend) {
  RoadShape shape;
  const Span out_m = {5.0, 15.0};
  for (const Roadside& side : both_sides()) {
    EXPECT_DOUBLE_EQ(side.along_of(shape, 10.0, out_m), 10.0);
  }
  shape.curvature_per_m = 1.0 / 120.0;
  const auto [left, right] = both_sides();
  // An arc of length s at the distance 15 m on the inside has the length s (1 - 15 / 120).
  EXPECT_NEAR(left.along_of(shape, 10.0, out_m) * (1.0 - 15.0 / 120.0), 10.0, 1e-9);
  EXPECT_LT(right.along_of(shape, 10.0, out_m), 10.0);
}

}  // namespace
}  // namespace croon::simulation
