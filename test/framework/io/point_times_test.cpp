#include "framework/io/point_times.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace croon {
namespace {

constexpr double kStamp_s = 1.7e9;

TEST(PointTimes, AreRelativeToTheStampIfTheyAreNearZero) {
  for (const double begin_s : {0.0, -0.1, -0.05}) {
    EXPECT_EQ(time_offset_s(begin_s, begin_s + 0.1, kStamp_s), kStamp_s);
    EXPECT_EQ(time_offset_s(begin_s, begin_s + 0.1, 500.0), 500.0);
  }
  for (const double clock_s : {0.0, 5.0, 500.0, 5e6, kStamp_s}) {
    EXPECT_EQ(time_offset_s(clock_s, clock_s + 0.1, clock_s), 0.0) << clock_s;
  }
  EXPECT_EQ(time_offset_s(500.0, 500.1, kStamp_s), 0.0) << "another clock";
}

template <class Number>
std::vector<double> converted(const std::vector<Number>& times, double stamp_s) {
  PointCloud cloud(Points(times.size(), {1, 2, 3}));
  set_channel(cloud, make_channel(kTime, times));
  convert_times(cloud, stamp_s);
  EXPECT_EQ(find_channel(cloud, kTime)->type, scalar_type_of<double>());
  return times_s(cloud);
}

TEST(PointTimes, BecomeSecondsInDoublePrecision) {
  const std::vector<std::vector<double>> all = {
      converted(std::vector<std::uint32_t>{0, 50000000, 100000000}, kStamp_s),
      converted(std::vector<float>{0.0f, 0.05f, 0.1f}, kStamp_s),
      converted(std::vector<double>{1.7e9, 1.7e9 + 0.05, 1.7e9 + 0.1}, kStamp_s),
      converted(std::vector<double>{1.7e18, 1.7e18 + 5e7, 1.7e18 + 1e8}, kStamp_s),
      converted(std::vector<double>{0.0, 5e7, 1e8}, kStamp_s)};
  for (const std::vector<double>& times : all) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_NEAR(times[i], kStamp_s + 0.05 * static_cast<double>(i), 1e-6);
    }
  }
}

TEST(PointTimes, ThatAreNotFiniteStay) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<double> times = converted(std::vector<float>{-0.1f, nan, 0.0f}, kStamp_s);
  EXPECT_NEAR(times[0], kStamp_s - 0.1, 1e-6);
  EXPECT_TRUE(std::isnan(times[1]));
  PointCloud without(Points(3, {1, 2, 3}));
  convert_times(without, kStamp_s);
  EXPECT_TRUE(without.channels.empty());
}

}  // namespace
}  // namespace croon
