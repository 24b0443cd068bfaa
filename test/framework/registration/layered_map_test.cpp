#include "framework/registration/layered_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

/// The street with its ground at 0.
Points levelled_street(Rng& rng, std::uint64_t scene_seed, int count) {
  return transformed(test::random_street(rng, scene_seed, count, 0.01),
                     {Eigen::Matrix3d::Identity(), {0.0, 0.0, 2.0}});
}

TEST(LayeredMap, FindsYawAndShiftOverTheWholeCircle) {
  Rng rng = test::test_rng();
  const LayeredMapOptions options;
  for (std::uint64_t i = 0; i < 8; ++i) {
    const LayeredMap view(levelled_street(rng, i, 20000), 2.0, options);
    const double yaw_rad = rng.uniform(-kPi, kPi);
    const RigidTransform T = {rotation_exp({0.0, 0.0, yaw_rad}),
                              {rng.uniform(-8.0, 8.0), rng.uniform(-8.0, 8.0), 0.0}};
    const Points source = transformed(levelled_street(rng, i, 12000), T.inverse());
    const std::vector<MapPeak> peaks = view.match({source, options}, 3);
    ASSERT_FALSE(peaks.empty());
    EXPECT_LT(std::abs(std::remainder(peaks[0].yaw_rad - yaw_rad, 2.0 * kPi)),
              rad_from_deg(1.5 * options.yaw_step_deg))
        << "street " << i;
    EXPECT_NEAR(peaks[0].x_m, T.translation.x(), 1.5 * options.cell_m) << "street " << i;
    EXPECT_NEAR(peaks[0].y_m, T.translation.y(), 1.5 * options.cell_m) << "street " << i;
  }
}

TEST(LayeredMap, PeaksAreApartAndBestFirst) {
  Rng rng = test::test_rng(2);
  const LayeredMapOptions options;
  const LayeredMap view(levelled_street(rng, 3, 20000), 2.0, options);
  const std::vector<MapPeak> peaks = view.match({levelled_street(rng, 3, 12000), options}, 10);
  ASSERT_EQ(peaks.size(), 10U);
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const MapPeak &a = peaks[i], &b = peaks[k];
      const double turn_rad = std::abs(std::remainder(a.yaw_rad - b.yaw_rad, 2.0 * kPi));
      const double shift_m = std::max(std::abs(a.x_m - b.x_m), std::abs(a.y_m - b.y_m));
      // Yaws are whole steps and shifts whole cells: apart is at least one more.
      EXPECT_TRUE(turn_rad > rad_from_deg(3.5 * options.yaw_step_deg) ||
                  shift_m > 2.5 * options.cell_m)
          << k << " and " << i;
    }
  }
  for (std::size_t i = 1; i < peaks.size(); ++i) {
    EXPECT_LE(peaks[i].score, peaks[i - 1].score);
    EXPECT_GE(peaks[i].score, 0.0);
    EXPECT_LE(peaks[i].score, 1.0);
  }
}

/// The points of a straight wall, 3 m high.
void add_wall(Points& points, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const int columns = static_cast<int>((to - from).norm() / 0.25);
  for (int i = 0; i <= columns; ++i) {
    const Eigen::Vector2d at = from + (to - from) * i / columns;
    for (int k = 0; k < 12; ++k) {
      points.emplace_back(static_cast<float>(at.x()), static_cast<float>(at.y()),
                          0.25F * static_cast<float>(k));
    }
  }
}

TEST(LayeredMap, FreeSpaceCountsAgainstWhatIsInFrontOfASurfaceOnly) {
  Rng rng = test::test_rng(4);
  for (int i = 0; i < 8; ++i) {
    const double ahead_m = rng.uniform(10.0, 14.0);
    Points wall;
    add_wall(wall, {ahead_m, -8.0}, {ahead_m, 8.0});
    LayeredMapOptions options;
    options.max_sensor_distance_m = 0.5;
    const auto best_score = [&](double object_m, double free_space) {
      Points seen = wall;
      add_wall(seen, {object_m, -2.0}, {object_m, 2.0});
      options.free_space = free_space;
      return LayeredMap(wall, 1.5, options).match({seen, options}, 1).at(0).score;
    };
    const double in_front_m = rng.uniform(4.0, ahead_m - 4.0);
    EXPECT_LT(best_score(in_front_m, 2.0), best_score(in_front_m, 0.0) - 0.1) << i;
    const double behind_m = ahead_m + rng.uniform(2.0, 6.0);
    EXPECT_DOUBLE_EQ(best_score(behind_m, 2.0), best_score(behind_m, 0.0)) << i;
  }
}

TEST(LayeredMap, HasNoPeakWhereNothingStandsOnTheGround) {
  Points plain;
  for (int i = 0; i < 1000; ++i) plain.emplace_back(0.1F * static_cast<float>(i % 30), 0.0F, 0.0F);
  Rng rng = test::test_rng(3);
  EXPECT_TRUE(LayeredMap(levelled_street(rng, 3, 5000), 2.0, {}).match({plain, {}}, 3).empty());
  EXPECT_TRUE(LayeredMap(plain, 2.0, {}).match({levelled_street(rng, 3, 5000), {}}, 3).empty());
}

}  // namespace
}  // namespace croon
