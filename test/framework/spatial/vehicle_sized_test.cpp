#include "framework/spatial/vehicle_sized.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

/// A thing that stands on the ground: where its middle is, how long, wide and high it is.
struct Block {
  double x_m, y_m, length_m, width_m, height_m;
};

/// Points every 0.2 m on the sides and the top of a block, z = 0 being the ground.
Points points_on(const Block& block) {
  constexpr double kStep_m = 0.2;
  Points points;
  for (double u = -block.length_m / 2; u <= block.length_m / 2; u += kStep_m) {
    for (double v = -block.width_m / 2; v <= block.width_m / 2; v += kStep_m) {
      const bool is_side =
          std::abs(u) + kStep_m > block.length_m / 2 || std::abs(v) + kStep_m > block.width_m / 2;
      for (double z = is_side ? 0.0 : block.height_m; z <= block.height_m; z += kStep_m) {
        points.push_back(Eigen::Vector3d(block.x_m + u, block.y_m + v, z).cast<float>());
      }
    }
  }
  return points;
}

/// How many points of `blocks`, that are high enough, belong to things of a vehicle's size, and how
/// many such points there are; on ground of any slope, seen from anywhere.
std::pair<int, int> found_and_all(const std::vector<Block>& blocks, Rng& rng) {
  const VehicleSize size;
  Points level;
  for (const Block& block : blocks) {
    const Points points = points_on(block);
    level.insert(level.end(), points.begin(), points.end());
  }
  RigidTransform T = test::random_pose(rng, 1.0);
  T.translation -= T.rotation.col(2) * 2.0;
  const Eigen::Vector3d up = T.rotation.col(2);
  const Points points = transformed(level, T);
  const std::vector<bool> found = is_vehicle_sized(points, {up, -up.dot(T.translation)}, size);
  int hits = 0, all = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    hits += found[i] ? 1 : 0;
    // Not those within rounding of the least height.
    all += level[i].z() > size.min_height_m + 0.01 ? 1 : 0;
  }
  return {hits, all};
}

TEST(VehicleSized, AreCarsVansAndBuses) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 5; ++i) {
    for (const Block& block : {Block{6, 3, 4.5, 1.8, 1.5}, Block{-9, 1, 6.0, 2.2, 2.6},
                               Block{12, -8, 12.0, 2.5, 3.2}, Block{5, 5, 1.8, 0.6, 1.2}}) {
      const auto [hits, all] = found_and_all({block}, rng);
      EXPECT_EQ(hits, all) << block.length_m;
      EXPECT_GT(all, 30);
    }
  }
}

TEST(VehicleSized, AreNoPostsWallsHousesAndRows) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 5; ++i) {
    for (const Block& block :
         {Block{6, 3, 0.4, 0.4, 3.0}, Block{0, 7, 30.0, 0.2, 2.0}, Block{12, -8, 8.0, 8.0, 7.0},
          Block{4, 4, 4.5, 1.8, 6.0}, Block{10, 10, 10.0, 6.0, 3.0}}) {
      EXPECT_EQ(found_and_all({block}, rng).first, 0) << block.length_m;
    }
    std::vector<Block> row;
    for (double x = -9.0; x < 10.0; x += 4.8) row.push_back({x, 5.0, 4.5, 1.8, 1.5});
    EXPECT_EQ(found_and_all(row, rng).first, 0);
    // Farther apart, each of them is one.
    for (Block& car : row) car.x_m *= 1.5;
    const auto [hits, all] = found_and_all(row, rng);
    EXPECT_EQ(hits, all);
  }
}

TEST(VehicleSized, AreNeitherTheGroundNorFarAway) {
  Rng rng = test::test_rng();
  EXPECT_EQ(found_and_all({{0, 0, 5.0, 2.0, 0.2}}, rng).first, 0);
  EXPECT_EQ(found_and_all({{70, 0, 4.5, 1.8, 1.5}}, rng).first, 0);
  EXPECT_TRUE(is_vehicle_sized({}, Plane{}, {}).empty());
}

}  // namespace
}  // namespace croon
