#include "framework/geometry/time_unit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/geometry/point_cloud.hpp"

namespace croon {
namespace {

constexpr ScalarKind kFloat = ScalarKind::floating, kInt = ScalarKind::unsigned_integer;

/// Times of 2000 points from `first` on, evenly over `length`.
std::vector<double> scan(double first, double length) {
  std::vector<double> times;
  for (int i = 0; i < 2000; ++i) times.push_back(first + length * i / 1999.0);
  return times;
}

TEST(TimeUnit, IsThatOfTheDriver) {
  // Velodyne and simulators; Hesai and RoboSense; Livox; Ouster as exported, and as integers.
  EXPECT_EQ(unit_of_times(scan(-0.1, 0.1), kFloat), TimeUnit::seconds);
  EXPECT_EQ(unit_of_times(scan(1.7e9, 0.1), kFloat), TimeUnit::seconds);
  EXPECT_EQ(unit_of_times(scan(1.7e18, 1e8), kFloat), TimeUnit::nanoseconds);
  EXPECT_EQ(unit_of_times(scan(0.0, 1e8), kFloat), TimeUnit::nanoseconds);
  EXPECT_EQ(unit_of_times(scan(0.0, 1e8), kInt), TimeUnit::nanoseconds);
  EXPECT_EQ(unit_of_times(scan(1.7e18, 1e8), kInt), TimeUnit::nanoseconds);
  // Microseconds past the hour, and since 1970; milliseconds.
  for (const ScalarKind kind : {kFloat, kInt}) {
    EXPECT_EQ(unit_of_times(scan(1.8e9, 1e5), kind), TimeUnit::microseconds);
    EXPECT_EQ(unit_of_times(scan(1.7e15, 1e5), kind), TimeUnit::microseconds);
    EXPECT_EQ(unit_of_times(scan(0.0, 100.0), kind), TimeUnit::milliseconds);
  }
}

TEST(TimeUnit, IsThatOfTheConventionWhereItIsPossible) {
  for (const double length_s : {0.0, 5e-4, 0.05, 0.2, 3.0, 10.0}) {
    EXPECT_EQ(unit_of_times(scan(0.0, length_s), kFloat), TimeUnit::seconds);
    EXPECT_EQ(unit_of_times(scan(0.0, 1e9 * length_s), kInt), TimeUnit::nanoseconds);
  }
  EXPECT_EQ(unit_of_times({}, kFloat), TimeUnit::seconds);
  EXPECT_EQ(unit_of_times({std::nan(""), std::nan("")}, kInt), TimeUnit::nanoseconds);
  // Of no scan in any unit.
  EXPECT_EQ(unit_of_times(scan(0.0, 1e12), kFloat), TimeUnit::seconds);
}

TEST(TimeUnit, IgnoresTimesThatAreNotFinite) {
  std::vector<double> times = scan(0.0, 1e8);
  times[7] = std::nan("");
  times[8] = HUGE_VAL;
  EXPECT_EQ(unit_of_times(times, kFloat), TimeUnit::nanoseconds);
}

TEST(TimeUnit, OfChannelsIsSeconds) {
  PointCloud cloud = Points(2000, Eigen::Vector3f::Ones());
  cloud.channels = {make_channel(kTime, scan(1.7e18, 1e8))};
  EXPECT_NEAR(times_s(cloud).back() - times_s(cloud).front(), 0.1, 1e-6);
  EXPECT_NEAR(times_s(cloud).front(), 1.7e9, 1e-3);
}

/// Times that start again `restarts` times and reach `length` each time.
std::vector<double> repeated(int restarts, double length) {
  std::vector<double> times;
  for (int i = 0; i <= restarts; ++i) {
    for (int k = 0; k < 200; ++k) times.push_back(length * k / 199.0);
  }
  return times;
}

TEST(TimesInPackets, AreShortAndStartAgain) {
  EXPECT_TRUE(restart_in_packets(repeated(75, 1.3e-3), kFloat));
  EXPECT_TRUE(restart_in_packets(repeated(75, 3e-4), kFloat));
  EXPECT_TRUE(restart_in_packets(repeated(75, 1.3e6), kInt));
  EXPECT_TRUE(restart_in_packets(repeated(75, 1300.0), kInt));
}

TEST(TimesInPackets, AreNotThoseOfAScanRingAfterRing) {
  for (const double length_s : {0.05, 0.1, 0.2, 5.0}) {
    EXPECT_FALSE(restart_in_packets(repeated(63, length_s), kFloat)) << length_s;
    EXPECT_FALSE(restart_in_packets(repeated(63, 1e9 * length_s), kInt)) << length_s;
  }
  EXPECT_FALSE(restart_in_packets(repeated(63, 1e5), kInt)) << "microseconds";
  EXPECT_FALSE(restart_in_packets(repeated(63, 1e5), kFloat)) << "microseconds";
  EXPECT_FALSE(restart_in_packets(repeated(63, 100.0), kInt)) << "milliseconds";
  EXPECT_FALSE(restart_in_packets(repeated(3, 1.3e-3), kFloat)) << "a few packets";
  EXPECT_FALSE(restart_in_packets(scan(0.0, 0.1), kFloat));
  EXPECT_FALSE(restart_in_packets(scan(0.0, 0.0), kFloat));
}

}  // namespace
}  // namespace croon
