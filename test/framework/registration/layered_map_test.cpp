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
    const LayeredMap view(levelled_street(rng, i, 20000), options);
    const double yaw_rad = rng.uniform(-kPi, kPi);
    const RigidTransform T = {rotation_exp({0.0, 0.0, yaw_rad}),
                              {rng.uniform(-8.0, 8.0), rng.uniform(-8.0, 8.0), 0.0}};
    const Points source = transformed(levelled_street(rng, i, 12000), T.inverse());
    const std::vector<MapPeak> peaks = view.match(source, 3);
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
  const LayeredMap view(levelled_street(rng, 3, 20000), options);
  const std::vector<MapPeak> peaks = view.match(levelled_street(rng, 3, 12000), 10);
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

TEST(LayeredMap, HasNoPeakWhereNothingStandsOnTheGround) {
  Points plain;
  for (int i = 0; i < 1000; ++i) plain.emplace_back(0.1F * static_cast<float>(i % 30), 0.0F, 0.0F);
  Rng rng = test::test_rng(3);
  EXPECT_TRUE(LayeredMap(levelled_street(rng, 3, 5000), {}).match(plain, 3).empty());
  EXPECT_TRUE(LayeredMap(plain, {}).match(levelled_street(rng, 3, 5000), 3).empty());
}

}  // namespace
}  // namespace croon
