// Lanes, traffic and streets: lines between the lanes, vehicles in them, the car among the
// vehicles.
#include "framework/simulation/scenes/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/simulation/scenes/motorway.hpp"
#include "framework/simulation/scenes/street.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using test::test_rng;

constexpr std::uint64_t kLaneSeeds = 30;
constexpr CarBody kLanesCar = {4.7, 1.9};

Lanes random_lanes(Rng& rng) {
  Lanes lanes;
  lanes.each_way = draw_int(rng, 1, 4);
  lanes.width_m = rng.uniform(2.8, 3.75);
  lanes.half_median_m = chance(rng, 0.5) ? rng.uniform(0.9, 2.2) : 0.0;
  return lanes;
}

std::vector<double> sorted_positions(const std::vector<LaneLine>& lines) {
  std::vector<double> positions_m;
  for (const LaneLine& line : lines) positions_m.push_back(line.d_m);
  std::sort(positions_m.begin(), positions_m.end());
  return positions_m;
}

TEST(LaneLines, BoundEachLaneOnBothSides) {
  for (std::uint64_t seed = 1; seed <= kLaneSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const Lanes lanes = random_lanes(rng);
    const std::vector<double> lines_m = sorted_positions(lane_lines(lanes, true));
    for (const double side : {-1.0, 1.0}) {
      for (int lane = 0; lane < lanes.each_way; ++lane) {
        const double middle_m = side * lanes.middle_m(lane);
        const auto next = std::lower_bound(lines_m.begin(), lines_m.end(), middle_m);
        ASSERT_NE(next, lines_m.begin());
        ASSERT_NE(next, lines_m.end());
        EXPECT_NEAR(*next - middle_m, 0.5 * lanes.width_m, 1e-9);
        EXPECT_NEAR(middle_m - *(next - 1), 0.5 * lanes.width_m, 1e-9);
      }
    }
    EXPECT_NEAR(lines_m.back(), lanes.edge_m(), 1e-9);
    EXPECT_NEAR(lines_m.front(), -lanes.edge_m(), 1e-9);
  }
}

TEST(LaneLines, AreDashedBetweenLanesOfOneDirectionAndSolidAtEdges) {
  for (std::uint64_t seed = 1; seed <= kLaneSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const Lanes lanes = random_lanes(rng);
    for (const LaneLine& line : lane_lines(lanes, true)) {
      const double out_m = std::abs(line.d_m);
      if (out_m == 0.0) {
        // Overtaking is allowed on roads with one lane each way.
        EXPECT_EQ(line.is_dashed, lanes.each_way == 1);
      } else {
        const bool is_between = out_m > lanes.half_median_m + 1e-9 && out_m < lanes.edge_m() - 1e-9;
        EXPECT_EQ(line.is_dashed, is_between) << "seed " << seed;
      }
    }
    EXPECT_EQ(lane_lines(lanes, true).size(), lane_lines(lanes, false).size() + 2);
  }
}

TEST(DrawCarPose, IsInItsLaneOnTheRight) {
  for (std::uint64_t seed = 1; seed <= kLaneSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const Lanes lanes = random_lanes(rng);
    const int lane = draw_int(rng, 0, lanes.each_way - 1);
    const RoadPose pose = draw_car_pose(lanes, lane, rng);
    EXPECT_NEAR(pose.d_m, -lanes.middle_m(lane), 0.35);
    EXPECT_NEAR(pose.yaw_rad, 0.0, 0.0524);
    EXPECT_EQ(pose.s_m, 0.0);
  }
}

TEST(AddTraffic, StaysInItsLaneInItsDirectionWithGaps) {
  for (std::uint64_t seed = 1; seed <= kLaneSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    RoadShape shape = test::random_road(rng);
    const Traffic traffic = {rng.uniform(0.0, 30.0), {6.0, 30.0}};
    for (const Roadside& side : both_sides()) {
      SceneBuilder builder(shape, StreamKey(seed));
      const double out_m = rng.uniform(1.5, 12.0);
      add_traffic(builder, side, {-150.0, 150.0}, out_m, traffic, Rng(StreamKey(seed)));
      const World world = builder.finish();
      ASSERT_GE(world.bodies.size(), 4U);
      double front_m = -1e9;
      for (const Body& body : world.bodies) {
        const Vector2d road = test::road_coordinates(shape, body.T_world_body.translation);
        EXPECT_NEAR(road.y(), side.sign * out_m, 0.35);
        const double heading_rad = Ground(shape, StreamKey(0)).heading_rad(road.x());
        const Eigen::Vector3d ahead = body.T_world_body.rotation.col(0);
        const double along = ahead.x() * std::cos(heading_rad) + ahead.y() * std::sin(heading_rad);
        EXPECT_LT(side.sign * along, -0.98);
        const double half_m = 0.5 * test::bounds_of(body.mesh).sizes().x();
        EXPECT_GE(road.x() - half_m, front_m + traffic.gap_m.from - 0.1);
        front_m = road.x() + half_m;
        EXPECT_NEAR(body.motion.speed_mps, traffic.speed_mps, 0.1 * traffic.speed_mps + 1e-9);
      }
    }
  }
}

TEST(AddTraffic, LeavesTheCarItsLane) {
  for (std::uint64_t seed = 1; seed <= kLaneSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const Lanes lanes = random_lanes(rng);
    SceneBuilder builder(RoadShape{}, StreamKey(seed));
    builder.put_car(draw_car_pose(lanes, 0, rng), kLanesCar, 10.0);
    add_traffic(builder, lanes, {-60.0, 60.0}, {10.0, {1.0, 2.0}});
    const World world = builder.finish();
    const RigidTransform T_car_world = world.car.T_world_body.inverse();
    for (const Body& body : world.bodies) {
      for (const Eigen::Vector3f& vertex :
           transformed(body.mesh.vertices, T_car_world * body.T_world_body)) {
        ASSERT_FALSE(test::is_in_car(kLanesCar, vertex)) << "seed " << seed;
      }
    }
  }
}

TEST(DrawStreet, HasItsLanesAndParkingBetweenItsKerbsAndHousesBehindItsPavements) {
  for (std::uint64_t seed = 1; seed <= 10 * kLaneSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const int least = 1 + static_cast<int>(seed % 2);
    const Street street = draw_street(least, rng);
    EXPECT_GE(street.lanes.each_way, least);
    EXPECT_GE(street.shape.half_width_m, street.lanes.edge_m() + 2.0);
    EXPECT_GT(street.shape.kerb_height_m, 0.05);
    for (const LaneLine& line : street.shape.lines) {
      EXPECT_LT(std::abs(line.d_m), street.shape.half_width_m);
    }
    for (const double front_m : street.front_m) {
      EXPECT_GE(front_m, street.shape.half_width_m + street.shape.pavement_width_m);
    }
  }
}

TEST(DrawMotorway, IsWideSeparatedAndWithoutKerbs) {
  for (std::uint64_t seed = 1; seed <= 10 * kLaneSeeds; ++seed) {
    Rng rng = test_rng(seed);
    const Motorway motorway = draw_motorway(rng);
    EXPECT_GE(motorway.lanes.each_way, 2);
    EXPECT_GT(motorway.lanes.half_median_m, 0.5);
    EXPECT_GT(motorway.shape.half_width_m, motorway.lanes.edge_m());
    EXPECT_EQ(motorway.shape.kerb_height_m, 0.0);
    EXPECT_LE(std::abs(motorway.shape.curvature_per_m), 1.0 / 400.0);
  }
}

}  // namespace
}  // namespace croon::simulation
