#include "framework/registration/scene_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/registration/joint_rivals.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

constexpr double kLater_s = 0.05;  // So much later than the target the sensor scans.

/// A plate of points every 0.1 m, `wide_m` by `high_m`, that faces along x; its middle is at `at`.
void add_plate(Points& points, const Eigen::Vector3f& at, float wide_m, float high_m) {
  for (float y = -wide_m / 2; y <= wide_m / 2; y += 0.1F) {
    for (float z = -high_m / 2; z <= high_m / 2; z += 0.1F) {
      points.emplace_back(at + Eigen::Vector3f(0.0F, y, z));
    }
  }
}

TimedScan scan_of(Points points, double time_s) {
  const std::vector<double> times_s(points.size(), time_s);
  return {std::make_shared<const Cloud>(PointCloud(std::move(points)), StreamKey(1)), times_s};
}

/// A standing rig between walls, where signs stand and a lorry moves by `lorry_m` between the two
/// scans: its back has more points than all signs.
JointScene street(int signs, float lorry_m, double later_s = kLater_s) {
  Rng rng = test::test_rng();
  Points fixed;
  for (float x = -20.0F; x <= 20.0F; x += 0.2F) {
    for (float across = -6.0F; across <= 6.0F; across += 0.2F) {
      fixed.emplace_back(x, across, -2.0F);
      for (const float wall : {-7.0F, 7.0F}) fixed.emplace_back(x, wall, across / 3.0F);
    }
  }
  for (int i = 0; i < signs; ++i) {
    const float x = -18.0F + 36.0F * static_cast<float>(i) / static_cast<float>(signs);
    add_plate(fixed, {x, i % 2 == 0 ? -5.0F : 5.0F, static_cast<float>(rng.uniform(0.0, 1.0))},
              0.8F, 0.8F);
  }
  Points before = fixed, after = fixed;
  add_plate(before, {11.0F, 0.0F, 0.0F}, 5.0F, 3.0F);
  add_plate(after, {11.0F + lorry_m, 0.0F, 0.0F}, 5.0F, 3.0F);
  JointScene scene;
  scene.target = scan_of(std::move(before), 0.0);
  scene.sources = {{0, scan_of(std::move(after), later_s)}};
  return scene;
}

/// The sensor `x_m` along the road, and no motion.
JointState sensor_at(double x_m) {
  JointState state;
  state.T_target_sensor.resize(1);
  state.T_target_sensor[0].translation.x() = x_m;
  state.clock_offsets_s = {0.0};
  state.velocities = {Twist{}};
  return state;
}

std::optional<double> lead(const JointScene& scene, double x_m, double rival_x_m,
                           double vehicle_weight = 1.0) {
  JointOptions options;
  options.vehicle_weight = vehicle_weight;
  options.points = 100000;
  return leads_over_rivals(scene, scene, sensor_at(x_m), {sensor_at(rival_x_m)}, options, options)
      .at(0);
}

TEST(LeadOverRivals, ManySignsAreAheadOfOneLorry) {
  const JointScene scene = street(10, 0.5F);
  const std::optional<double> truth = lead(scene, 0.0, -0.5);
  const std::optional<double> lorry = lead(scene, -0.5, 0.0);
  ASSERT_TRUE(truth);
  ASSERT_TRUE(lorry);
  EXPECT_GT(*truth, 0.5);
  EXPECT_NEAR(*truth, -*lorry, 0.05);
}

TEST(LeadOverRivals, FallsWithTheNumberOfSigns) {
  const double many = *lead(street(10, 0.5F), 0.0, -0.5);
  const double few = *lead(street(2, 0.5F), 0.0, -0.5);
  EXPECT_LT(few, many);
  EXPECT_LT(few, 0.5);
}

/// How well two scans of one plate agree that faces along x, the second `off_m` behind it.
double agreement_at(double off_m, const std::optional<Eigen::Vector3d>& axis = std::nullopt) {
  Points plate;
  add_plate(plate, {8.0F, 0.0F, 0.0F}, 10.0F, 10.0F);
  JointScene scene;
  scene.target = scan_of(plate, 0.0);
  scene.sources = {{0, scan_of(plate, 0.0)}};
  const JointOptions options;
  const DeskewedTarget target(scene, Twist{}, options);
  const JointState state = sensor_at(off_m);
  double sum = 0.0;
  const PairAgreement pair =
      pair_agreement(scene.sources[0], target, last_view(state, Twist{}, options));
  for (const auto& [cell, agreeing] : pair.by_cell(axis)) sum += agreeing;
  return sum;
}

TEST(PairAgreement, PointsBeyondTheKernelsWidthSpeakAgainstThePose) {
  const double width_m = JointOptions{}.kernel_width_m;
  EXPECT_GT(agreement_at(0.0), agreement_at(0.5 * width_m));
  EXPECT_NEAR(agreement_at(width_m), 0.0, 1e-4 * agreement_at(0.0));
  EXPECT_LT(agreement_at(2.0 * width_m), 0.0);
}

TEST(PairAgreement, CountsSurfacesByHowMuchTheyFaceAlongTheAxis) {
  const double all = agreement_at(0.0);
  EXPECT_NEAR(agreement_at(0.0, Eigen::Vector3d::UnitX()), all, 1e-4 * all);
  EXPECT_NEAR(agreement_at(0.0, Eigen::Vector3d(0.6, 0.8, 0.0)), 0.6 * all, 1e-4 * all);
  EXPECT_NEAR(agreement_at(0.0, Eigen::Vector3d::UnitY()), 0.0, 1e-4 * all);
}

TEST(LeadOverRivals, RisesIfTheLorryWeighsLess) {
  const JointScene scene = street(2, 0.5F);
  const double as_others = *lead(scene, 0.0, -0.5);
  const double little = *lead(scene, 0.0, -0.5, 0.1);
  EXPECT_LT(as_others, little);
  EXPECT_GT(*lead(scene, 0.0, -0.5, 0.0), little);
  EXPECT_GT(*lead(scene, 0.0, -0.5, 0.0), 0.5);
}

TEST(LeadOverRivals, IsOfTheSensorsThatARivalHasElsewhere) {
  // A second sensor that stands where the first does and scans when the target does: a lorry that
  // moves between the two scans moves the first alone.
  JointScene scene = street(2, 0.5F);
  JointScene at_once = street(2, 0.0F, 0.0);
  scene.sources.push_back({1, at_once.sources[0].scan});
  const auto rig_at = [](double x_m) {
    JointState state = sensor_at(x_m);
    state.T_target_sensor.emplace_back();
    state.clock_offsets_s.push_back(0.0);
    return state;
  };
  JointOptions options;
  options.points = 100000;
  const auto leads = leads_over_rivals(scene, scene, rig_at(0.0), {rig_at(-0.5)}, options, options);
  ASSERT_EQ(leads.size(), 2U);
  EXPECT_TRUE(leads[0]);
  EXPECT_FALSE(leads[1]);
}

TEST(LeadOverRivals, IsNothingIfAllStartsEndAtTheState) {
  EXPECT_FALSE(lead(street(10, 0.5F), 0.0, 0.05));
  EXPECT_FALSE(lead(street(10, 0.0F), 0.0, -0.2));
}

TEST(OtherSpeeds, KeepTheCloudsWhereTheyMet) {
  const JointScene scene = street(10, 0.0F);
  const Eigen::Vector3d axis = Eigen::Vector3d(3.0, 4.0, 0.0).normalized();
  const std::vector<double> speeds_mps = {-10.0, 0.0, 25.0};
  const auto states = other_speeds(scene, sensor_at(0.0), axis, speeds_mps, JointOptions{});
  ASSERT_EQ(states.size(), 3U);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Eigen::Vector3d velocity_mps = states[i].velocities.front().linear_mps;
    EXPECT_NEAR((velocity_mps - speeds_mps[i] * axis).norm(), 0.0, 1e-12);
    const Eigen::Vector3d met = states[i].T_target_sensor[0].translation + kLater_s * velocity_mps;
    EXPECT_NEAR(met.norm(), 0.0, 1e-9);
  }
}

TEST(DeskewedTarget, HasItsPointsAtTheVelocityAndFindsThemToTheShift) {
  Rng rng = test::test_rng(3);
  Points points;
  std::vector<double> times_s;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d point = test::random_point(rng, 15.0);
    points.push_back(point.cast<float>());
    times_s.push_back(rng.uniform(0.0, 0.1));
  }
  JointScene scene;
  scene.target = {std::make_shared<const Cloud>(PointCloud(points), StreamKey(1)), times_s};
  scene.reference_s = 0.05;
  const JointOptions options;
  Twist velocity{{0.0, 0.02, -0.1}, {12.0, 0.5, -0.1}};
  DeskewedTarget target(scene, velocity, options);
  constexpr double kShift_m = 0.02;
  for (int i = 0; i < 30; ++i) {
    for (double& part : velocity.linear_mps) part += rng.uniform(-0.1, 0.1);
    for (double& part : velocity.angular_radps) part += rng.uniform(-0.005, 0.005);
    target.set_velocity(velocity, kShift_m);
    const DeskewedTarget fresh(scene, velocity, options);
    const Eigen::Vector3d query = test::random_point(rng, 15.0);
    const int found = target.nearest(query, 100.0).index;
    const int nearest = fresh.nearest(query, 100.0).index;
    EXPECT_EQ(target.surface(found).point, fresh.surface(found).point);
    const double too_far_m =
        (fresh.surface(found).point - query).norm() - (fresh.surface(nearest).point - query).norm();
    EXPECT_LT(too_far_m, 2.0 * kShift_m + 1e-4) << i;
  }
}

TEST(ShiftOfAnUnknownVelocity, IsTheWayBetweenTheTwoScans) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance(3, 3) = 2.0 * 2.0;
  covariance(4, 4) = 1.0;
  covariance(3, 4) = covariance(4, 3) = -1.0;
  const auto shift = [&](double later_s) {
    const JointScene scene = street(10, 0.0F, later_s);
    const JointOptions options;
    const DeskewedTarget target(scene, Twist{}, options);
    return shift_std_m(target, covariance, sensor_at(0.0), options).front();
  };
  EXPECT_NEAR(shift(0.05), 0.05 * std::sqrt(5.0), 1e-3);
  EXPECT_NEAR(shift(-0.02), 0.02 * std::sqrt(5.0), 1e-3);
  EXPECT_EQ(shift(0.0), 0.0);
}

TEST(SceneMotion, RejectsWhatIsNotCertainAndHasNoLead) {
  const MotionOptions options;
  SceneMotion motion;
  motion.shift_std_m = {0.1, 0.001};
  motion.leads.resize(2);
  motion.covariance(3, 3) = 0.03 * 0.03;
  motion.covariance(4, 4) = 0.04 * 0.04;
  EXPECT_DOUBLE_EQ(speed_std_mps(motion.covariance), 0.05);
  EXPECT_FALSE(motion.is_in_doubt(options));
  motion.covariance(3, 3) = 0.04;
  EXPECT_TRUE(motion.is_in_doubt(options));
  EXPECT_EQ(motion.rejection(0, options), "");
  motion.leads = {3.0, 3.0};
  EXPECT_EQ(motion.rejection(0, options), "");
  motion.leads = {0.2, 0.2};
  EXPECT_EQ(motion.rejection(0, options),
            "the standard deviation of the speed, m/s, is 0.204, and the lead over another speed, "
            "in standard deviations, is 0.20, below 1.50");
  EXPECT_EQ(motion.rejection(1, options), "") << "It sees things when the target sees them.";
  motion.leads = {std::nullopt, -0.2};
  EXPECT_EQ(motion.rejection(0, options), "") << "No other speed has it elsewhere.";
  EXPECT_EQ(motion.rejection(1, options),
            "the standard deviation of the speed, m/s, is 0.204, and the lead over another speed, "
            "in standard deviations, is -0.20, below 0.00");
}

TEST(SceneMotion, TheAxisIsTheVelocitysOrTheLeastKnown) {
  SceneMotion motion;
  motion.covariance(3, 3) = 0.01;
  motion.covariance(4, 4) = 4.0;
  Twist velocity;
  EXPECT_NEAR(std::abs(axis_of_motion(motion, velocity).y()), 1.0, 1e-12);
  velocity.linear_mps = {20.0, 0.0, 3.0};
  EXPECT_NEAR(axis_of_motion(motion, velocity).x(), 1.0, 1e-12);
  velocity.linear_mps = {-20.0, 0.0, 3.0};
  EXPECT_NEAR(axis_of_motion(motion, velocity).x(), -1.0, 1e-12);
}

}  // namespace
}  // namespace croon
