#include "framework/registration/sweep_times.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

constexpr int kRings = 16, kColumns = 720;

/// A revolution that begins at `begin_deg`, in the order of firing; rings fire up to 5 degrees
/// apart.
Points revolution(double begin_deg, bool is_clockwise) {
  Points points;
  Rng rng = test::test_rng();
  for (int column = 0; column < kColumns; ++column) {
    const double turned_deg = 360.0 * column / kColumns;
    for (int ring = 0; ring < kRings; ++ring) {
      const double azimuth_rad = rad_from_deg(
          begin_deg + (is_clockwise ? -turned_deg : turned_deg) + (ring % 2 == 0 ? 2.5 : -2.5));
      const double range_m = rng.uniform(3.0, 50.0);
      points.emplace_back(range_m * std::cos(azimuth_rad), range_m * std::sin(azimuth_rad),
                          0.1 * range_m * (ring - 8) / 8);
    }
  }
  return points;
}

Points ring_by_ring(const Points& points) {
  Points ordered;
  for (int ring = 0; ring < kRings; ++ring) {
    for (int column = 0; column < kColumns; ++column) {
      ordered.push_back(points[static_cast<std::size_t>(column * kRings + ring)]);
    }
  }
  return ordered;
}

TEST(SweepOf, FindsDirectionAndBeginInTheOrderOfFiring) {
  for (const double begin_deg : {-180.0, -75.0, 0.0, 130.0}) {
    for (const bool is_clockwise : {false, true}) {
      const Points points = revolution(begin_deg, is_clockwise);
      const Sweep sweep = sweep_of(points);
      EXPECT_EQ(sweep.is_clockwise, is_clockwise);
      const double off_rad = std::remainder(sweep.begin_rad - rad_from_deg(begin_deg), 2.0 * kPi);
      EXPECT_LT(std::abs(deg_from_rad(off_rad)), 4.0) << begin_deg;
      const std::vector<double> times = sweep_times_s(points, sweep, 0.1);
      // A twentieth of the revolution at both ends may be at the other one.
      for (std::size_t i = points.size() / 20; i < points.size() * 19 / 20; ++i) {
        EXPECT_NEAR(times[i], 0.1 * static_cast<double>(i) / static_cast<double>(points.size()),
                    0.002);
      }
    }
  }
}

TEST(SweepOf, FindsTheDirectionRingByRingAndNothingInOtherOrders) {
  EXPECT_TRUE(sweep_of(ring_by_ring(revolution(20.0, true))).is_clockwise);
  EXPECT_FALSE(sweep_of(ring_by_ring(revolution(20.0, false))).is_clockwise);
  Points shuffled = revolution(20.0, true);
  Rng rng = test::test_rng();
  for (std::size_t i = shuffled.size(); i > 1; --i) {
    const auto k = static_cast<std::size_t>(rng.uniform() * static_cast<double>(i));
    std::swap(shuffled[i - 1], shuffled[k]);
  }
  EXPECT_FALSE(sweep_of(shuffled).is_clockwise);
  EXPECT_EQ(sweep_of(shuffled).begin_rad, -kPi);
  EXPECT_TRUE(sweep_times_s({}, sweep_of({}), 0.1).empty());
}

}  // namespace
}  // namespace croon
