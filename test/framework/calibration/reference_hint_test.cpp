#include "framework/calibration/reference_hint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/calibration/reasons_in_words.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

/// A cloud of a LiDAR that measures over `azimuth_deg` and 30 degrees of elevation, and is mounted
/// at any angle.
std::shared_ptr<const Cloud> sector_cloud(Rng& rng, double azimuth_deg) {
  const Eigen::Matrix3d mounting = random_pose(rng, 0.0).rotation;
  Points points;
  for (int i = 0; i < 20000; ++i) {
    const double azimuth_rad = rad_from_deg(rng.uniform(-0.5, 0.5) * azimuth_deg);
    const double elevation_rad = rad_from_deg(rng.uniform(-20.0, 10.0));
    const Eigen::Vector3d ray(std::cos(elevation_rad) * std::cos(azimuth_rad),
                              std::cos(elevation_rad) * std::sin(azimuth_rad),
                              std::sin(elevation_rad));
    points.push_back((mounting * ray * rng.uniform(2.0, 40.0)).cast<float>());
  }
  return std::make_shared<const Cloud>(std::move(points), StreamKey(1));
}

/// A rig whose reference measures over `reference_deg`: "left" and "right" over 120 degrees, and
/// "top" all around. "left" was rejected because its common view is too small.
CalibratedRig rig_with_reference(Rng& rng, double reference_deg) {
  CalibratedRig rig;
  rig.reference = "front";
  rig.shown.reference = sector_cloud(rng, reference_deg);
  for (const char* name : {"left", "right", "top"}) {
    CalibratedSensor& sensor = rig.sensors.emplace_back();
    sensor.sensor = name;
    sensor.is_accepted = sensor.sensor != "left";
    if (!sensor.is_accepted) sensor.advice = {kMoreSharedView};
    rig.shown.sensors.push_back(
        {name, sector_cloud(rng, sensor.sensor == "top" ? 360.0 : 120.0), {}, {}});
  }
  SceneMotionEstimate& motion = rig.motion.emplace_back();
  motion.velocity.linear_mps.x() = 5.0;
  return rig;
}

TEST(ReferenceHint, NamesTheSensorThatSeesMoreForAnyMounting) {
  Rng rng = test_rng();
  for (int i = 0; i < 10; ++i) {
    const CalibratedRig rig = rig_with_reference(rng, 120.0);
    EXPECT_EQ(reference_hint(rig),
              "left shares too little view with the reference front, the first sensor; top has a "
              "larger field of view: try --reference top");
    EXPECT_EQ(reference_hint(rig_with_reference(rng, 360.0)), "");
  }
}

TEST(ReferenceHint, IsEmptyIfAnotherReferenceDoesNotHelp) {
  Rng rng = test_rng();
  const CalibratedRig rig = rig_with_reference(rng, 120.0);
  CalibratedRig other = rig;
  other.sensors.front().advice = {"Drive more slowly."};
  EXPECT_EQ(reference_hint(other), "");
  other = rig;
  other.motion.clear();  // The graph of sensors has compared left with top.
  EXPECT_EQ(reference_hint(other), "");
  other.sensors.back().is_accepted = false;
  EXPECT_NE(reference_hint(other), "");
  other.shown = {};
  EXPECT_EQ(reference_hint(other), "");
}

}  // namespace
}  // namespace croon::test
