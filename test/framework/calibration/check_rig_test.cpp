#include "framework/calibration/check_rig.hpp"

#include <gtest/gtest.h>

#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

/// A sensor that was calibrated to `optimum`, with these standard deviations, and whose given pose
/// is off by `error`.
CalibratedSensor sensor_off_by(const RigidTransform& optimum, const Vector6d& error,
                               double std_rad = rad_from_deg(0.02), double std_m = 0.004) {
  CalibratedSensor sensor;
  sensor.sensor = "left";
  sensor.is_accepted = true;
  sensor.T_reference_sensor = optimum;
  sensor.covariance.emplace();
  for (int i = 0; i < 6; ++i) {
    const double std = i < 3 ? std_rad : std_m;
    sensor.covariance->matrix(i, i) = std * std;
  }
  sensor.nominal = moved(optimum, error);
  return sensor;
}

/// An error along one degree of freedom.
Vector6d along(Dof dof, double size) {
  Vector6d error = Vector6d::Zero();
  error(static_cast<int>(dof)) = size;
  return error;
}

TEST(CheckSensor, FindsTheDegreeOfFreedomThatIsOff) {
  Rng rng = test_rng(1);
  for (std::size_t i = 0; i < kDofNames.size(); ++i) {
    const auto dof = static_cast<Dof>(i);
    const double size = is_rotation(dof) ? rad_from_deg(-0.3) : 0.05;
    const CheckedSensor checked =
        check_sensor(sensor_off_by(random_pose(rng, 2.0), along(dof, size)));
    EXPECT_EQ(checked.judgement, PoseJudgement::wrong);
    EXPECT_EQ(checked.finding.substr(0, checked.finding.find(' ')), kDofNames.at(i));
    EXPECT_NEAR(checked.difference(static_cast<int>(i)), size, 1e-9);
    EXPECT_GT(checked.distance, kWrongDistance);
  }
  const CheckedSensor checked =
      check_sensor(sensor_off_by({}, along(Dof::yaw, rad_from_deg(0.42)), rad_from_deg(0.0)));
  EXPECT_EQ(checked.finding, "yaw is off by +0.42° (8.4 standard deviations)");
}

TEST(CheckSensor, AcceptsWhatTheDeviationsAndTheScatterOfScenesAllow) {
  Rng rng = test_rng(2);
  for (int i = 0; i < 50; ++i) {
    Vector6d error;
    for (int k = 0; k < 6; ++k) error(k) = rng.normal() * (k < 3 ? kScatter_rad : kScatter_m);
    const CheckedSensor checked = check_sensor(sensor_off_by(random_pose(rng, 2.0), error));
    EXPECT_EQ(checked.judgement, PoseJudgement::right) << checked.finding;
    EXPECT_EQ(checked.finding.substr(0, 7), "within ");
  }
}

TEST(CheckSensor, UsesTheCorrelationOfTheDegreesOfFreedom) {
  CalibratedSensor sensor = sensor_off_by({}, along(Dof::y, 0.09));
  // Only y + 10 m * yaw is known.
  const double slack = 0.05;
  Vector6d direction = along(Dof::y, 1.0) + along(Dof::yaw, -0.1);
  sensor.covariance->matrix += slack * slack * direction * direction.transpose();
  EXPECT_EQ(check_sensor(sensor).judgement, PoseJudgement::wrong);
  sensor.nominal = moved({}, 0.09 * direction);
  EXPECT_EQ(check_sensor(sensor).judgement, PoseJudgement::right) << check_sensor(sensor).finding;
}

TEST(CheckSensor, CannotTellWhereTheCloudsDoNotConstrainThePose) {
  CalibratedSensor sensor = sensor_off_by({}, along(Dof::x, 0.3));
  sensor.covariance->matrix(3, 3) = 0.16;
  const CheckedSensor checked = check_sensor(sensor);
  EXPECT_EQ(checked.judgement, PoseJudgement::undecidable);
  EXPECT_NE(checked.finding.find("do not constrain x (±0.4"), std::string::npos) << checked.finding;
  sensor.nominal = moved(*sensor.nominal, along(Dof::pitch, rad_from_deg(1.0)));
  EXPECT_EQ(check_sensor(sensor).judgement, PoseJudgement::wrong);
}

TEST(CheckSensor, LetsAPoseFoundNearTheGivenOneOnlyRefuteIt) {
  CalibratedSensor rejected = sensor_off_by({}, Vector6d::Zero());
  rejected.is_accepted = false;
  rejected.reasons = {"Another pose explains the clouds as well."};
  EXPECT_EQ(check_sensor(rejected).judgement, PoseJudgement::undecidable);
  EXPECT_EQ(check_sensor(rejected).reasons, rejected.reasons);
  EXPECT_FALSE(check_sensor(rejected).optimum);
  const CalibratedSensor same = sensor_off_by({}, Vector6d::Zero());
  EXPECT_EQ(check_sensor(rejected, &same).judgement, PoseJudgement::undecidable);
  CalibratedSensor other = same;
  other.T_reference_sensor = moved({}, along(Dof::z, 0.05));
  EXPECT_EQ(check_sensor(rejected, &other).judgement, PoseJudgement::wrong);
}

TEST(CheckRig, PairsTheSensorsByName) {
  CalibratedRig from_nothing;
  from_nothing.sensors = {sensor_off_by({}, Vector6d::Zero()), sensor_off_by({}, Vector6d::Zero())};
  from_nothing.sensors[1].sensor = "right";
  from_nothing.sensors[1].is_accepted = false;
  CalibratedSensor none;
  none.sensor = "front";
  from_nothing.sensors.push_back(none);
  CalibratedRig near;
  near.sensors = {from_nothing.sensors[1], from_nothing.sensors[0]};
  near.sensors[0].is_accepted = true;
  near.sensors[0].nominal.reset();
  near.sensors[0].T_reference_sensor = moved({}, along(Dof::z, 0.1));
  const std::vector<CheckedSensor> checked = check_rig(from_nothing, near);
  ASSERT_EQ(checked.size(), 3U);
  EXPECT_EQ(checked[0].judgement, PoseJudgement::right);
  EXPECT_EQ(checked[1].judgement, PoseJudgement::wrong);
  EXPECT_EQ(checked[2].judgement, PoseJudgement::undecidable);
  EXPECT_EQ(checked[2].finding, "no pose was given for it");
}

}  // namespace
}  // namespace croon::test
