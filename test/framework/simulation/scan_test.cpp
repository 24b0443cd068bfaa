#include "framework/simulation/scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/base/statistics.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// A room of 20 x 16 x 8 m about the sensor, of plaster.
std::shared_ptr<const World> room() {
  auto world = std::make_shared<World>();
  add_box(world->fixed, {-10.0, -8.0, -4.0}, {10.0, 8.0, 4.0}, Material::plaster);
  return world;
}

SensorModel small_sensor() {
  SensorModel sensor;
  sensor.elevations_deg = {-20.0, -5.0, 0.0, 5.0, 20.0};
  sensor.azimuth_step_deg = 1.0;
  return sensor;
}

ScanPlan at_rest() {
  return {0.0, [](double) { return RigidTransform{}; }};
}

PointCloud scanned(const Noise& noise, const ScanPlan& plan = at_rest()) {
  const RayCaster caster(room(), {0.0, noise.moves_during_scan ? 0.5 : 0.0});
  return scan(caster, small_sensor(), noise, plan, StreamKey(3));
}

/// The range to the room's walls along a direction.
double range_in_room_m(const Vector3d& direction) {
  const Vector3d half(10.0, 8.0, 4.0);
  return half.cwiseQuotient(direction.cwiseAbs().cwiseMax(1e-12)).minCoeff();
}

TEST(Scan, WithoutNoiseEveryRayComesBackFromItsWall) {
  const PointCloud cloud = scanned({});
  ASSERT_EQ(cloud.points.size(), 5U * 360U);
  const std::vector<double> ring = channel_values(cloud, kRing);
  const std::vector<double> intensity = channel_values(cloud, kIntensity);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vector3d point = cloud.points[i].cast<double>();
    EXPECT_NEAR(point.norm(), range_in_room_m(point.normalized()), 1e-5);
    EXPECT_EQ(ring[i], static_cast<double>(i % 5));
    EXPECT_NEAR(std::asin(point.z() / point.norm()),
                rad_from_deg(small_sensor().elevations_deg[i % 5]), 1e-6);
    EXPECT_GE(intensity[i], 0.0);
    EXPECT_LE(intensity[i], 255.0);
  }
  EXPECT_EQ(times_s(cloud).front(), 0.0);
  EXPECT_NEAR(times_s(cloud).back(), 0.1 * 359.0 / 360.0, 1e-12);
}

TEST(Scan, RangeNoiseHasItsDeviation) {
  Noise noise;
  noise.range_std_m = 0.05;
  double squares = 0.0;
  const PointCloud cloud = scanned(noise);
  for (const Eigen::Vector3f& p : cloud.points) {
    const Vector3d point = p.cast<double>();
    squares += std::pow(point.norm() - range_in_room_m(point.normalized()), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(cloud.points.size())), 0.05, 0.005);
}

TEST(Scan, DropoutLosesItsShare) {
  Noise noise;
  noise.dropout_ratio = 0.25;
  EXPECT_NEAR(static_cast<double>(scanned(noise).points.size()), 0.75 * 1800, 90.0);
  noise.dropout_ratio = 1.0;
  EXPECT_TRUE(scanned(noise).points.empty());
}

TEST(Scan, DetectionIsAHalfAtItsRange) {
  Noise noise;
  noise.detection_range_m = 80.0;
  EXPECT_NEAR(detection_probability(noise, 80.0, 0.1), 0.5, 1e-12);
  EXPECT_NEAR(detection_probability(noise, 160.0, 0.4), 0.5, 1e-12);
  double last = 1.0;
  for (double range_m = 10.0; range_m < 300.0; range_m += 10.0) {
    const double now = detection_probability(noise, range_m, 0.1);
    EXPECT_LE(now, last);
    last = now;
  }
  EXPECT_EQ(detection_probability(noise, 10.0, 0.0), 0.0);
  EXPECT_EQ(detection_probability({}, 1e6, 0.0), 1.0);
}

TEST(Scan, DistortionShiftsPointsAsTheCarMoves) {
  constexpr double kSpeed_mps = 20.0;
  const ScanPlan driving = {
      0.05, [](double time_s) {
        return RigidTransform{Eigen::Matrix3d::Identity(), {kSpeed_mps * time_s, 0.0, 0.0}};
      }};
  Noise noise;
  noise.moves_during_scan = true;
  const PointCloud moving = scanned(noise, driving);
  const std::vector<double> time_s = times_s(moving);
  int on_walls_ahead = 0;
  for (std::size_t i = 0; i < moving.points.size(); ++i) {
    const double x_m = static_cast<double>(moving.points[i].x()) + kSpeed_mps * time_s[i];
    const double y_m = moving.points[i].y();
    EXPECT_TRUE(std::abs(x_m - 10.0) < 1e-4 || std::abs(x_m + 10.0) < 1e-4 ||
                std::abs(std::abs(y_m) - 8.0) < 1e-4 ||
                std::abs(std::abs(moving.points[i].z()) - 4.0F) < 1e-4F);
    on_walls_ahead += std::abs(x_m - 10.0) < 1e-4 ? 1 : 0;
    EXPECT_GE(time_s[i], 0.05);
  }
  EXPECT_GT(on_walls_ahead, 100);
  // Without motion during the scan all is at time 0, at any speed of the car.
  const PointCloud still = scanned({}, driving);
  ASSERT_EQ(still.points.size(), scanned({}).points.size());
  EXPECT_EQ(still.points, scanned({}).points);
}

TEST(Scan, ARosetteFillsItsEllipseWithoutRings) {
  for (const char* name : {"rosette_38", "rosette_77"}) {
    SCOPED_TRACE(name);
    const SensorModel& sensor = sensor_model(name);
    const RayCaster caster(room(), {});
    const PointCloud cloud = scan(caster, sensor, {}, at_rest(), StreamKey(3));
    EXPECT_EQ(cloud.points.size(), static_cast<std::size_t>(sensor.rosette_rays));
    EXPECT_EQ(find_channel(cloud, kRing), nullptr);
    EXPECT_NEAR(times_s(cloud).back(), sensor.period_s, 1e-4);
    // The ellipse, scaled to the unit disc, in five rings of the same area and 12 sectors.
    std::vector<int> counts(60, 0);
    double farthest = 0.0;
    for (const Eigen::Vector3f& p : cloud.points) {
      const Vector3d d = p.cast<double>().normalized();
      const double scale =
          2.0 * deg_from_rad(std::acos(d.x())) / std::max(std::hypot(d.y(), d.z()), 1e-12);
      const double left = scale * d.y() / sensor.rosette_width_deg;
      const double up = scale * d.z() / sensor.rosette_height_deg;
      farthest = std::max(farthest, std::hypot(left, up));
      const int band = std::min(static_cast<int>(5.0 * (left * left + up * up)), 4);
      const double turn = 0.5 + std::atan2(up, left) / (2.0 * kPi);
      ++counts[static_cast<std::size_t>(12 * band + std::min(static_cast<int>(12.0 * turn), 11))];
    }
    EXPECT_NEAR(farthest, 1.0, 1e-3);
    const double mean = static_cast<double>(cloud.points.size()) / 60.0;
    for (const int count : counts) EXPECT_GT(count, 0.3 * mean);
    // The same key gives the same bits, another one other petals.
    EXPECT_EQ(scan(caster, sensor, {}, at_rest(), StreamKey(3)).points, cloud.points);
    EXPECT_NE(scan(caster, sensor, {}, at_rest(), StreamKey(4)).points, cloud.points);
  }
}

/// The ranges of a scan with rays of 0.2 degrees at a wall at 10 m, with a plate 0.6 m before it,
/// relative to the wall: 0 on the wall, 1 on the plate.
std::vector<double> shares_between_walls(double footprint_deg) {
  auto world = std::make_shared<World>();
  add_box(world->fixed, {10.0, -20.0, -10.0}, {11.0, 20.0, 10.0}, Material::plaster);
  add_box(world->fixed, {9.4, -1.0, -1.0}, {9.5, 1.0, 1.0}, Material::plaster);
  const RayCaster caster(world, {});
  Noise noise;
  noise.footprint_deg = footprint_deg;
  const PointCloud cloud = scan(caster, sensor_model("rosette_38"), noise, at_rest(), StreamKey(3));
  std::vector<double> shares;
  for (const Eigen::Vector3f& point : cloud.points) {
    shares.push_back((10.0 - static_cast<double>(point.x())) / 0.6);
  }
  return shares;
}

TEST(Scan, WideRaysMixRangesAtEdgesOnly) {
  const auto count_between = [](const std::vector<double>& shares) {
    return std::count_if(shares.begin(), shares.end(),
                         [](double share) { return share > 0.01 && share < 0.99; });
  };
  const std::vector<double> mixed = shares_between_walls(0.2);
  EXPECT_EQ(count_between(shares_between_walls(0.0)), 0);
  EXPECT_GT(*std::min_element(mixed.begin(), mixed.end()), -0.01);
  EXPECT_LT(*std::max_element(mixed.begin(), mixed.end()), 1.01);
  const auto at_edges = count_between(mixed);
  EXPECT_GT(at_edges, 20);
  EXPECT_LT(at_edges, static_cast<std::ptrdiff_t>(mixed.size() / 50));
}

}  // namespace
}  // namespace croon::simulation
