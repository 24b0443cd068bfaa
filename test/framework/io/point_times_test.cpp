#include "framework/io/point_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace croon {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

constexpr double kStamp_s = 1.7e9;

TEST(PointTimes, HaveTheUnitInWhichAScanIsAsLong) {
  for (const ScalarType type : {scalar_type_of<float>(), scalar_type_of<double>(),
                                scalar_type_of<std::uint32_t>(), scalar_type_of<std::uint64_t>()}) {
    for (const double unit_s : {1.0, 1e-3, 1e-6, 1e-9}) {
      for (const double scan_s : {0.01, 0.05, 0.1, 0.2, 1.0}) {
        const TimeRule relative = time_rule(type, 0.0, scan_s / unit_s, kStamp_s);
        EXPECT_EQ(relative.unit_s, unit_s);
        EXPECT_EQ(relative.offset_s, kStamp_s);
        const TimeRule negative = time_rule(type, -scan_s / unit_s, 0.0, kStamp_s);
        EXPECT_EQ(negative.unit_s, unit_s);
        EXPECT_EQ(negative.offset_s, kStamp_s);
        const TimeRule absolute =
            time_rule(type, kStamp_s / unit_s, (kStamp_s + scan_s) / unit_s, kStamp_s);
        EXPECT_EQ(absolute.unit_s, unit_s);
        EXPECT_EQ(absolute.offset_s, 0.0);
      }
    }
  }
}

TEST(PointTimes, OfAClockSinceTheStartOfTheSensorStay) {
  for (const double boot_s : {5.0, 500.0, 5e4, 5e6}) {
    const TimeRule rule =
        time_rule(scalar_type_of<double>(), boot_s * 1e9, (boot_s + 0.1) * 1e9, boot_s);
    EXPECT_EQ(rule.unit_s, 1e-9) << boot_s;
    EXPECT_EQ(rule.offset_s, 0.0) << boot_s;
  }
}

TEST(PointTimes, WithoutASpanGoByTheType) {
  EXPECT_EQ(time_rule(scalar_type_of<float>(), 0.0, 0.0, kStamp_s).unit_s, 1.0);
  EXPECT_EQ(time_rule(scalar_type_of<std::uint32_t>(), 0.0, 0.0, kStamp_s).unit_s, 1e-9);
}

TEST(PointTimes, BecomeSecondsInDoublePrecision) {
  PointCloud cloud(Points(3, {1, 2, 3}));
  convert_times(cloud, kStamp_s);
  EXPECT_TRUE(cloud.channels.empty());
  set_channel(cloud, make_channel(kTime, std::vector<std::uint32_t>{0, 50000000, 100000000}));
  convert_times(cloud, kStamp_s);
  EXPECT_THAT(times_s(cloud),
              Pointwise(DoubleNear(1e-6), {kStamp_s, kStamp_s + 0.05, kStamp_s + 0.1}));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  set_channel(cloud, make_channel(kTime, std::vector<float>{-0.1f, nan, 0.0f}));
  convert_times(cloud, 0.0);
  EXPECT_NEAR(times_s(cloud)[0], -0.1, 1e-6);
  EXPECT_NE(times_s(cloud)[1], times_s(cloud)[1]);
}

}  // namespace
}  // namespace croon
