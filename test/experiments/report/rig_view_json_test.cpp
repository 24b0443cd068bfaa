#include "experiments/report/rig_view_blocks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

std::string decoded_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, value = 0;
  for (const char c : text.substr(0, text.find('='))) {
    value = (value << 6U | static_cast<unsigned>(digits.find(c))) & 0xFFFFU;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(value >> bits & 0xFFU);
  }
  return bytes;
}

RigView view_with(const Points& points) {
  RigView view;
  view.scene = "a";
  view.states = {"nominal", "result"};
  ViewedSensor& sensor = view.sensors.emplace_back();
  sensor.sensor = "top\xff";
  sensor.is_reference = true;
  sensor.points = points;
  sensor.poses = {std::nullopt, RigidTransform{rotation_from_rpy({0.1, 0.2, 0.3}), {1, 2, 3}}};
  return view;
}

TEST(RigViewJson, QuantisesPointsToHalfAStep) {
  Rng rng = test::test_rng();
  for (const double extent_m : {0.5, 10.0, 200.0}) {
    Points points = test::random_cloud(rng, 500, extent_m);
    for (Eigen::Vector3f& point : points) point.x() += 50.0F;
    const auto json = nlohmann::json::parse(rig_view_json(view_with(points)));
    const auto& sensor = json["sensors"][0];
    ASSERT_EQ(sensor["count"], points.size());
    const std::string bytes = decoded_base64(sensor["points"]);
    ASSERT_EQ(bytes.size(), 6 * points.size());
    const double scale_m = sensor["scale_m"];
    EXPECT_GE(scale_m, 1e-3);
    EXPECT_LE(scale_m, std::max(1e-3, extent_m / 32000.0));
    for (std::size_t i = 0; i < 3 * points.size(); ++i) {
      const auto low = static_cast<std::uint8_t>(bytes[2 * i]);
      const auto high = static_cast<std::uint8_t>(bytes[2 * i + 1]);
      const double value = static_cast<std::int16_t>(low | high << 8);
      const int axis = static_cast<int>(i % 3);
      const double origin_m = sensor["origin_m"][i % 3];
      EXPECT_NEAR(value * scale_m + origin_m, points[i / 3](axis), 0.5 * scale_m + 1e-6);
    }
  }
}

TEST(RigViewJson, HasDistancesInBytesAndPosesAsRows) {
  RigView view = view_with({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  view.sensors[0].distances[1] = {0.0F, 0.0101F, 5.0F, std::numeric_limits<float>::quiet_NaN()};
  const auto json = nlohmann::json::parse(rig_view_json(view));
  const auto& sensor = json["sensors"][0];
  EXPECT_EQ(json["states"], view.states);
  EXPECT_EQ(json["distance_unit_m"], 0.002);
  EXPECT_EQ(decoded_base64(sensor["distances"]["1"]), std::string("\0\5\xfe\xff", 4));
  EXPECT_TRUE(sensor["poses"][0].is_null());
  const RigidTransform& T = *view.sensors[0].poses[1];
  for (std::size_t row = 0; row < 3; ++row) {
    const auto r = static_cast<int>(row);
    EXPECT_EQ(sensor["poses"][1][4 * row], T.rotation(r, 0));
    EXPECT_EQ(sensor["poses"][1][4 * row + 3], T.translation(r));
  }
  EXPECT_EQ(sensor["poses"][1][15], 1.0);
  EXPECT_EQ(sensor["name"], "top\xef\xbf\xbd");
  EXPECT_EQ(sensor["role"], "reference");
  EXPECT_FALSE(sensor.contains("rival"));
}

TEST(RigViewJson, AcceptsASensorWithoutPoints) {
  const auto json = nlohmann::json::parse(rig_view_json(view_with({})));
  EXPECT_EQ(json["sensors"][0]["count"], 0);
  EXPECT_EQ(json["sensors"][0]["points"], "");
}

}  // namespace
}  // namespace croon::experiments
