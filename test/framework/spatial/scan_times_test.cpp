#include "framework/spatial/scan_times.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/base/angles.hpp"
#include "framework/simulation/rig.hpp"
#include "framework/simulation/simulated_scene.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

enum class Order { firing, rings, shuffled };

/// A scan of 32 rings by a LiDAR that turns once, or over a part of a turn.
struct Spinner {
  bool is_clockwise = false;
  double begin_deg = -180.0;
  double turn_deg = 360.0;
  double begin_s = 0.0;
  Order order = Order::firing;
};

template <class Value>
void shuffle(std::vector<Value>& values, Rng& rng) {
  for (std::size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1], values[static_cast<std::size_t>(rng.uniform(0.0, 1.0) * i) % i]);
  }
}

PointCloud scan_of(const Spinner& spinner) {
  constexpr int kRings = 32, kColumns = 360;
  struct Point {
    Eigen::Vector3f xyz;
    double time_s;
    int ring, column;
  };
  std::vector<Point> points;
  Rng rng = test::test_rng();
  for (int column = 0; column < kColumns; ++column) {
    const double share = static_cast<double>(column) / kColumns;
    const double turned_deg = share * spinner.turn_deg * (spinner.is_clockwise ? -1.0 : 1.0);
    for (int ring = 0; ring < kRings; ++ring) {
      const double azimuth_rad = rad_from_deg(spinner.begin_deg + turned_deg);
      const double elevation_rad = rad_from_deg(-25.0 + ring * 1.25);
      const double range_m = rng.uniform(2.0, 60.0);
      const Eigen::Vector3d direction(std::cos(elevation_rad) * std::cos(azimuth_rad),
                                      std::cos(elevation_rad) * std::sin(azimuth_rad),
                                      std::sin(elevation_rad));
      // The rings fire one after the other, the last ring first.
      const double time_s = spinner.begin_s + 0.1 * share + 1e-6 * (kRings - ring);
      points.push_back({(range_m * direction).cast<float>(), time_s, ring, column});
    }
  }
  if (spinner.order == Order::shuffled) shuffle(points, rng);
  if (spinner.order == Order::rings) {
    std::stable_sort(points.begin(), points.end(),
                     [](const Point& a, const Point& b) { return a.ring < b.ring; });
  }
  PointCloud cloud;
  std::vector<double> times;
  for (const Point& point : points) {
    cloud.points.push_back(point.xyz);
    times.push_back(point.time_s);
  }
  set_channel(cloud, make_channel(kTime, times));
  return cloud;
}

PointCloud with_times(PointCloud cloud, const std::vector<double>& times) {
  set_channel(cloud, make_channel(kTime, times));
  return cloud;
}

std::vector<double> reversed(std::vector<double> times) {
  const auto [low, high] = std::minmax_element(times.begin(), times.end());
  const double sum = *low + *high;
  for (double& time : times) time = sum - time;
  return times;
}

std::vector<double> permuted(std::vector<double> times) {
  Rng rng = test::test_rng();
  shuffle(times, rng);
  return times;
}

const std::vector<Spinner> kSpinners = {{},
                                        {true, 90.0},
                                        {false, -60.0, 120.0},
                                        {true, 10.0, 360.0, 1.7e9},
                                        {false, -180.0, 360.0, 0.0, Order::rings},
                                        {true, 0.0, 360.0, 0.0, Order::rings}};

TEST(CheckTimes, AcceptsTheTimesOfScans) {
  for (const Spinner& spinner : kSpinners) EXPECT_EQ(check_times(scan_of(spinner)).reason, "");
  Spinner shuffled;
  shuffled.order = Order::shuffled;
  EXPECT_TRUE(check_times(scan_of(shuffled)).is_usable);
}

TEST(CheckTimes, FindsPermutedTimes) {
  for (const Spinner& spinner : kSpinners) {
    const PointCloud cloud = scan_of(spinner);
    const TimeCheck check = check_times(with_times(cloud, permuted(times_s(cloud))));
    EXPECT_TRUE(check.has_times);
    EXPECT_NE(check.reason.find("unrelated to the directions"), std::string::npos);
  }
}

TEST(CheckTimes, FindsReversedTimes) {
  for (const Spinner& spinner : kSpinners) {
    const PointCloud cloud = scan_of(spinner);
    const TimeCheck check = check_times(with_times(cloud, reversed(times_s(cloud))));
    EXPECT_NE(check.reason.find("reversed"), std::string::npos) << check.reason;
  }
}

TEST(CheckTimes, SaysWhyTimesAreNotUsable) {
  const PointCloud cloud = scan_of({});
  std::vector<double> times = times_s(cloud);
  EXPECT_FALSE(check_times(PointCloud(cloud.points)).has_times);
  EXPECT_EQ(check_times(with_times(cloud, std::vector<double>(times.size()))).reason,
            "all times are equal");
  std::vector<double> in_packets = times;
  for (double& time : in_packets) time = std::fmod(time, 1.2e-3);
  EXPECT_NE(check_times(with_times(cloud, in_packets)).reason.find("restart"), std::string::npos);
  std::vector<double> in_microseconds = times;
  for (double& time : in_microseconds) time *= 1e6;
  EXPECT_TRUE(check_times(with_times(cloud, in_microseconds)).is_usable);
  times[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check_times(with_times(cloud, times)).reason, "1 of 11520 times are not finite");
}

TEST(CheckTimes, JudgesEverySensorOfASimulatedRig) {
  for (const auto& [rig_name, rig] : simulation::rigs()) {
    auto recipe = std::make_shared<simulation::Recipe>();
    recipe->rig = rig;
    recipe->noise = simulation::real_noise();
    const simulation::SimulatedScene scene(recipe, 3);
    for (const auto& [sensor, mounting] : rig.sensors) {
      const PointCloud cloud = scene.scan_of(sensor);
      const std::vector<double> times = times_s(cloud);
      EXPECT_EQ(check_times(cloud).reason, "") << rig_name << " " << sensor;
      EXPECT_FALSE(check_times(with_times(cloud, permuted(times))).is_usable) << sensor;
      EXPECT_FALSE(check_times(with_times(cloud, reversed(times))).is_usable) << sensor;
    }
  }
}

TEST(WhyNotOneClock, AcceptsScansThatOverlapAndNamesClocksThatDiffer) {
  const PointCloud top = scan_of({});
  const auto reason = [&](double begin_s) {
    Spinner spinner;
    spinner.begin_s = begin_s;
    const PointCloud left = scan_of(spinner);
    return why_not_one_clock({"top", "left"}, {&top, &left});
  };
  EXPECT_EQ(reason(0.0), "");
  EXPECT_EQ(reason(0.04), "");
  EXPECT_EQ(reason(-0.04), "");
  EXPECT_NE(reason(0.05), "");
  EXPECT_NE(reason(0.1).find("left is 100 ms later than the scan of top"), std::string::npos);
  EXPECT_NE(reason(-0.1).find("100 ms earlier"), std::string::npos);
  EXPECT_NE(reason(1.5e9).find("different epochs"), std::string::npos);
}

}  // namespace
}  // namespace croon
