#include "framework/spatial/ground_regions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/error.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

constexpr double kRoad_m = -2.0;  // Of random_street.

TEST(GroundRegions, HoldTheRoadAndLittleElse) {
  Rng rng = test::test_rng();
  for (std::uint64_t i = 0; i < 5; ++i) {
    const Points street = test::random_street(rng, i, 30000, 0.01);
    std::vector<bool> is_ground(street.size(), false);
    for (const int k : ground_region_points(street, {})) is_ground[k] = true;
    int road = 0;
    int found = 0;
    int wrong = 0;
    for (std::size_t k = 0; k < street.size(); ++k) {
      const bool is_road = std::abs(street[k].z() - kRoad_m) < 0.05;
      road += is_road ? 1 : 0;
      found += is_road && is_ground[k] ? 1 : 0;
      wrong += street[k].z() > kRoad_m + 0.5 && is_ground[k] ? 1 : 0;
    }
    EXPECT_GT(found, 0.9 * road) << "street " << i;
    EXPECT_LT(wrong, 0.01 * found) << "street " << i;
  }
}

TEST(GroundRegions, FollowARoadThatBends) {
  // 4 % steeper beyond 15 m: 1 m above the plane of the road near the sensor at 40 m.
  Rng rng = test::test_rng(2);
  Points road;
  for (int i = 0; i < 40000; ++i) {
    const double x = rng.uniform(-40.0, 40.0);
    const double y = rng.uniform(-8.0, 8.0);
    road.push_back(Eigen::Vector3d(x, y, kRoad_m + 0.04 * std::max(0.0, x - 15.0)).cast<float>());
  }
  EXPECT_GT(ground_region_points(road, {}).size(), 0.8 * static_cast<double>(road.size()));
}

TEST(GroundRegions, AreNoneInACloudThatLiesOnItsSide) {
  Rng rng = test::test_rng(3);
  Points wall;
  for (int i = 0; i < 20000; ++i) {
    wall.push_back(
        Eigen::Vector3d{5.0, rng.uniform(-20.0, 20.0), rng.uniform(-2.0, 20.0)}.cast<float>());
  }
  EXPECT_THROW(ground_region_points(wall, {}), StageError);
  EXPECT_THROW(ground_region_points({}, {}), StageError);
}

}  // namespace
}  // namespace croon
