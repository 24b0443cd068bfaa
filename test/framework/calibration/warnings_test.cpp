#include "framework/calibration/warnings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

constexpr int kPoints = 2000;

LoadedCloud street(std::uint64_t seed, double scale = 1.0) {
  Rng rng = test_rng(seed);
  LoadedCloud cloud;
  for (const Eigen::Vector3f& point : random_street(rng, 1, kPoints, 0.01)) {
    cloud.add(scale * point.cast<double>());
  }
  return cloud;
}

/// As a file with millimetres has it.
LoadedCloud rounded(LoadedCloud cloud) {
  for (Eigen::Vector3f& point : cloud.points) {
    point = (point * 1000.0F).array().round().matrix() / 1000.0F;
  }
  return cloud;
}

LoadedCloud with_times(LoadedCloud cloud, double first_s) {
  std::vector<double> times;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    times.push_back(first_s + 0.1 * static_cast<double>(i) / static_cast<double>(cloud.size()));
  }
  set_channel(cloud, make_channel(kTime, times));
  return cloud;
}

/// The warnings joined to one text, a line each.
std::string text_of(const std::vector<std::string>& warnings) {
  std::string text;
  for (const std::string& warning : warnings) text += warning + "\n";
  return text;
}

std::string warned(const std::vector<NamedCloud>& clouds) {
  return text_of(warnings_about_clouds(clouds));
}

using Names = std::vector<std::string>;

TEST(WarningsAboutClouds, AreNoneForAnOrdinaryRecording) {
  const LoadedCloud a = with_times(street(1), 100.0), b = with_times(street(2), 100.02);
  const LoadedCloud c = with_times(street(3), 101.0), d = with_times(street(4), 101.02);
  const std::vector<NamedCloud> clouds = {
      {"1", "top", &a}, {"1", "left", &b}, {"2", "top", &c}, {"2", "left", &d}};
  EXPECT_EQ(warned(clouds), "");
  EXPECT_EQ(copied_scenes(clouds), Names());
}

TEST(WarningsAboutClouds, NameTwoSensorsWithOneContentInAnyFormat) {
  const LoadedCloud a = street(1);
  const LoadedCloud b = rounded(a);
  EXPECT_EQ(warned({{"1", "top", &a}, {"1", "left", &b}}),
            "top in scene 1 and left in scene 1 have the same points: is one file a copy of the "
            "other?\n");
}

TEST(WarningsAboutClouds, DoNotCountCopiesOfAScene) {
  const LoadedCloud a = street(1), b = street(2), c = street(3), d = street(4);
  const std::vector<NamedCloud> clouds = {{"1", "top", &a},  {"1", "left", &b}, {"2", "top", &c},
                                          {"2", "left", &d}, {"3", "top", &a},  {"3", "left", &b}};
  EXPECT_EQ(copied_scenes(clouds), Names{"3"});
  EXPECT_EQ(warned(clouds), "scene 3 is a copy of scene 1: it does not count as evidence\n");
}

TEST(WarningsAboutClouds, NameAScanThatWasRepeated) {
  const LoadedCloud a = street(1), b = street(2), c = street(3);
  const std::vector<NamedCloud> clouds = {
      {"1", "top", &a}, {"1", "left", &b}, {"2", "top", &c}, {"2", "left", &b}};
  EXPECT_EQ(copied_scenes(clouds), Names());
  EXPECT_NE(warned(clouds).find("the cloud of left in scene 2 is the same as in scene 1"),
            std::string::npos);
}

TEST(WarningsAboutClouds, NameTheUnitThatCoordinatesLookLike) {
  const LoadedCloud millimetres = street(1, 1000.0), centimetres = street(2, 100.0);
  const LoadedCloud map = [] {
    LoadedCloud cloud;
    for (const Eigen::Vector3f& p : street(3).points) {
      cloud.add(p.cast<double>() + Eigen::Vector3d(5000.0, 1000.0, 0.0));
    }
    return cloud;
  }();
  const auto looks = [&](const LoadedCloud& cloud) { return warned({{"1", "top", &cloud}}); };
  EXPECT_NE(looks(millimetres).find("looks like millimetres"), std::string::npos);
  EXPECT_NE(looks(centimetres).find("looks like centimetres"), std::string::npos);
  EXPECT_NE(looks(map).find("map coordinates"), std::string::npos);
  const LoadedCloud tiny = street(4, 0.001);
  EXPECT_NE(looks(tiny).find("are the coordinates in metres?"), std::string::npos);
}

TEST(WarningsAboutClouds, CountWhatIsNoMeasurementAndFewPoints) {
  LoadedCloud zeros = street(1);
  zeros.points.resize(3000, Eigen::Vector3f::Zero());
  zeros.dropped_zero = 1500;
  zeros.dropped_non_finite = 500;
  EXPECT_EQ(warned({{"1", "top", &zeros}}),
            "top in scene 1: 60 % of the points are not finite or exactly zero: no measurements\n");
  LoadedCloud few = street(1);
  few.points.resize(10);
  EXPECT_EQ(warned({{"1", "top", &few}}), "top in scene 1: only 10 points usable\n");
  const LoadedCloud none;
  EXPECT_EQ(warned({{"1", "top", &none}, {"1", "left", &none}}),
            "top in scene 1: only 0 points usable\nleft in scene 1: only 0 points usable\n");
}

TEST(WarningsAboutClouds, TellGapsInTimeFromOtherClocks) {
  const LoadedCloud a = with_times(street(1), 1.6e9), b = with_times(street(2), 1.6e9 + 1.4);
  const LoadedCloud c = with_times(street(3), 0.0);
  EXPECT_EQ(warned({{"1", "top", &a}, {"1", "left", &b}, {"1", "right", &c}}),
            "left in scene 1: its time stamps are 1.30 s away from those of top: if the vehicle "
            "moved in between, the pose is wrong by that motion\nright in scene 1: its time stamps "
            "are 444444 h away from those of top: the two clocks are not synchronised\n");
}

RigidTransform pose(double yaw_deg, double x_m, double y_m) {
  return moved({}, (Vector6d() << 0.0, 0.0, rad_from_deg(yaw_deg), x_m, y_m, -0.5).finished());
}

/// A rig of accepted sensors, each with this pose and nominal pose, in `scenes` scenes.
CalibratedRig rig_of(const std::vector<std::pair<RigidTransform, RigidTransform>>& poses,
                     std::size_t scenes = 2) {
  CalibratedRig rig;
  rig.reference = "top";
  for (const auto& [result, nominal] : poses) {
    CalibratedSensor sensor;
    sensor.sensor = std::string(1, static_cast<char>('a' + rig.sensors.size()));
    sensor.is_accepted = true;
    sensor.T_reference_sensor = result;
    sensor.nominal = nominal;
    sensor.scenes.resize(scenes);
    rig.sensors.push_back(sensor);
  }
  return rig;
}

std::string warned(const CalibratedRig& rig) { return text_of(warnings_about_rig(rig)); }

TEST(WarningsAboutRigs, AreNoneNearTheNominalPoses) {
  EXPECT_EQ(warned(rig_of({{pose(91.0, 0.1, 0.6), pose(90.0, 0.0, 0.6)},
                           {pose(-89.0, 0.1, -0.6), pose(-90.0, 0.0, -0.6)}})),
            "");
}

TEST(WarningsAboutRigs, NamePosesAtZeroAndAtOnePlace) {
  EXPECT_NE(
      warned(rig_of({{RigidTransform{}, pose(2.0, 0.0, 0.1)}})).find("a is at the pose of the"),
      std::string::npos);
  EXPECT_NE(warned(rig_of({{pose(90.0, 0.0, 0.6), RigidTransform{}}}))
                .find("a has a nominal pose of zero"),
            std::string::npos);
  const RigidTransform left = pose(90.0, 0.0, 0.6);
  EXPECT_NE(warned(rig_of({{left, left}, {pose(90.1, 0.01, 0.6), pose(-90.0, 0.0, -0.6)}}))
                .find("a and b have the same pose"),
            std::string::npos);
}

TEST(WarningsAboutRigs, NameWhatIsFarFromNominalAndWhy) {
  const RigidTransform nominal = pose(60.0, 1.0, 0.6);
  const auto warned_at = [&](const RigidTransform& result) {
    return warned(rig_of({{result, nominal}}));
  };
  EXPECT_EQ(warned_at(pose(72.0, 1.0, 0.6)), "a is 12.0° and 0.00 m from its nominal pose\n");
  EXPECT_NE(warned_at(pose(241.0, 1.0, 0.6)).find("is half a turn"), std::string::npos);
  EXPECT_NE(warned_at(nominal.inverse()).find("near its inverse"), std::string::npos);
}

TEST(WarningsAboutRigs, NameTwoSensorsThatLookSwapped) {
  const RigidTransform left = pose(90.0, 0.0, 0.6), right = pose(-90.0, 0.0, -0.6);
  EXPECT_EQ(warned(rig_of({{pose(-89.0, 0.0, -0.6), left}, {left, right}})),
            "a and b look swapped: each is at the nominal pose of the other (to within 1.0° and "
            "0.00 m, and 0.0° and 0.00 m)\n");
}

TEST(WarningsAboutRigs, NameOneSceneAloneAndLeaveRejectedPosesOut) {
  CalibratedRig rig = rig_of({{pose(90.0, 0.0, 0.6), pose(90.0, 0.0, 0.6)}}, 1);
  EXPECT_NE(warned(rig).find("the poses are from one scene"), std::string::npos);
  rig.sensors.front().is_accepted = false;
  rig.sensors.front().T_reference_sensor = pose(0.0, 5.0, 5.0);
  EXPECT_EQ(warned(rig), "");
}

}  // namespace
}  // namespace croon::test
