#include "framework/calibration/fit_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/base/angles.hpp"
#include "framework/calibration/rig_extrinsics.hpp"
#include "framework/calibration/warnings.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A street in which "left" was accepted at a pose that is wrong by `shift_m`.
CalibratedRig fitted_street(std::uint64_t seed, const Eigen::Vector3d& shift_m) {
  Rng rng = test_rng(seed);
  const RigidTransform T_top_left = {rotation_from_rpy({0.1, 0.0, 1.2}), {0.5, 0.6, -0.2}};
  const StreetPair pair = street_pair(rng, seed, T_top_left, 20000, 15000, 0.01);
  CalibratedRig rig;
  rig.reference = "top";
  rig.shown = {"0", std::make_shared<const Cloud>(pair.target, StreamKey(1)), {}};
  rig.shown.sensors.push_back(
      {"left", std::make_shared<const Cloud>(pair.source, StreamKey(1)), {}, {}});
  CalibratedSensor& left = rig.sensors.emplace_back();
  left.sensor = "left";
  left.is_accepted = true;
  left.T_reference_sensor = {T_top_left.rotation, T_top_left.translation + shift_m};
  set_refits(rig);
  return rig;
}

nlohmann::json fit_in_json(const CalibratedRig& rig) {
  return nlohmann::json::parse(rig_extrinsics_json(rig)).at("sensors").at(0).at("fit");
}

std::string launch_file(const CalibratedRig& rig) {
  return write_extrinsics(extrinsics_of(rig), "ros2", false).front().text;
}

TEST(FitCheck, ContradictsAPoseThatIsShiftedByFiveCentimetres) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Rng rng = test_rng(seed);
    const double angle_rad = rng.uniform(-kPi, kPi);
    // Few surfaces face along x, the direction of the street.
    const Eigen::Vector3d direction(0.0, std::cos(angle_rad), std::sin(angle_rad));
    const CalibratedRig right = fitted_street(seed, Eigen::Vector3d::Zero());
    EXPECT_FALSE(fit_in_json(right).at("is_contradicted").get<bool>());
    EXPECT_THAT(warnings_about_rig(right), Not(Contains(HasSubstr("contradict"))));
    EXPECT_THAT(launch_file(right), Not(HasSubstr("CONTRADICTED")));
    const CalibratedRig wrong = fitted_street(seed, 0.05 * direction);
    const nlohmann::json fit = fit_in_json(wrong);
    EXPECT_TRUE(fit.at("is_contradicted").get<bool>());
    EXPECT_GT(fit.at("surface_shift_m").get<double>(), kMaxSurfaceShift_m);
    EXPECT_NEAR(fit.at("translation_m").get<double>(), 0.05, 0.02);
    EXPECT_THAT(warnings_about_rig(wrong),
                Contains(HasSubstr("the clouds contradict the pose of left")));
    EXPECT_THAT(launch_file(wrong), HasSubstr("CONTRADICTED"));
  }
}

TEST(FitCheck, SaysNothingOfASensorWithoutACommonSurface) {
  const CalibratedRig rig = fitted_street(1, {1000.0, 0.0, 0.0});
  EXPECT_FALSE(rig.sensors.front().refit);
  EXPECT_TRUE(fit_in_json(rig).is_null());
  EXPECT_FALSE(is_doubtful(rig.sensors.front()));
}

TEST(FitCheck, DoubtsAcceptedSensorsOnly) {
  CalibratedRig rig = fitted_street(1, {0.0, 0.0, 0.05});
  EXPECT_TRUE(is_doubtful(rig.sensors.front()));
  rig.sensors.front().is_accepted = false;
  EXPECT_FALSE(is_doubtful(rig.sensors.front()));
  EXPECT_TRUE(is_contradicted(rig.sensors.front().refit));
  EXPECT_THAT(warnings_about_rig(rig), Not(Contains(HasSubstr("contradict"))));
}

}  // namespace
}  // namespace croon::test
