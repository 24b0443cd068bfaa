#include "framework/calibration/ground_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

/// A road whose unevenness has an amplitude of 1 cm, with walls and a car, in the road's frame, and
/// `noise_m` of noise. Seen from a height `height_m`, it is denser near the sensor.
Points random_road(Rng& rng, double noise_m, bool has_ground) {
  const double phase = rng.uniform(0.0, 6.0), waves_m = rng.uniform(2.0, 5.0);
  Points points;
  const auto add = [&](double x, double y, double z) {
    const Eigen::Vector3d noise{rng.normal(), rng.normal(), rng.normal()};
    points.push_back((Eigen::Vector3d(x, y, z) + noise_m * noise).cast<float>());
  };
  for (int i = 0; i < 12000; ++i) {
    const double range_m = 2.0 * std::exp(rng.uniform(0.0, 2.7)),
                 azimuth = rng.uniform(0.0, 6.2832);
    const double x = range_m * std::cos(azimuth), y = range_m * std::sin(azimuth);
    if (std::abs(y) > 8.0 || (azimuth > 1.0 && azimuth < 1.3)) continue;
    if (has_ground) add(x, y, 0.01 * std::sin(phase + x / waves_m) * std::cos(y / waves_m));
  }
  for (int i = 0; i < 5000; ++i) {
    const double wall_x_m = rng.uniform(-30.0, 30.0), wall_z_m = rng.uniform(0.0, 6.0);
    add(wall_x_m, i % 2 == 0 ? 8.0 : -8.0, wall_z_m);
    const double car_x_m = rng.uniform(5.0, 9.0), car_z_m = rng.uniform(0.0, 1.5);
    add(car_x_m, 2.0, car_z_m);
  }
  return points;
}

/// A mounting over the road.
GroundPose random_mounting(Rng& rng) {
  const bool is_upside_down = rng.uniform() < 0.3;
  const double roll_rad = rad_from_deg(rng.uniform(-40.0, 40.0)) + (is_upside_down ? kPi : 0.0);
  const double pitch_rad = rad_from_deg(rng.uniform(-40.0, 40.0));
  return {roll_rad, pitch_rad, rng.uniform(1.0, 2.5)};
}

TEST(GroundPose, IsThatOfTheMountingWithinItsStandardDeviations) {
  Rng rng = test_rng();
  int within_two = 0, within_four = 0, all = 0;
  for (int round = 0; round < 20; ++round) {
    const GroundPose truth = random_mounting(rng);
    std::vector<Points> scenes;
    for (int i = 0; i <= round % 3; ++i) {
      scenes.push_back(
          transformed(random_road(rng, 0.02, true), road_from_reference(truth).inverse()));
    }
    std::vector<const Points*> pointers;
    for (const Points& scene : scenes) pointers.push_back(&scene);
    const std::optional<GroundPose> found = ground_pose(pointers, rng);
    ASSERT_TRUE(found) << round;
    const auto angle = [](double a, double b) {
      return std::abs(std::remainder(a - b, 2.0 * kPi));
    };
    const double errors[] = {angle(found->roll_rad, truth.roll_rad),
                             angle(found->pitch_rad, truth.pitch_rad),
                             std::abs(found->height_m - truth.height_m)};
    const double deviations[] = {found->roll_std_rad, found->pitch_std_rad, found->height_std_m};
    EXPECT_LT(errors[0], rad_from_deg(0.3));
    EXPECT_LT(errors[1], rad_from_deg(0.3));
    EXPECT_LT(errors[2], 0.02);
    for (int i = 0; i < 3; ++i) {
      ++all;
      within_two += errors[i] < 2.0 * deviations[i] ? 1 : 0;
      within_four += errors[i] < 4.0 * deviations[i] ? 1 : 0;
      EXPECT_LT(deviations[i], i < 2 ? rad_from_deg(0.3) : 0.03);
    }
  }
  EXPECT_GT(within_two, 0.8 * all);
  EXPECT_GT(within_four, 0.96 * all);
  RecordProperty("within_two", within_two);
}

TEST(GroundPose, IsMissingWithoutGround) {
  Rng rng = test_rng();
  for (int round = 0; round < 5; ++round) {
    GroundPose mounting = random_mounting(rng);
    mounting.roll_rad = rad_from_deg(rng.uniform(-20.0, 20.0));
    mounting.pitch_rad = rad_from_deg(rng.uniform(-20.0, 20.0));
    const Points points =
        transformed(random_road(rng, 0.02, false), road_from_reference(mounting).inverse());
    EXPECT_FALSE(ground_pose({&points}, rng));
  }
  const Points none;
  EXPECT_FALSE(ground_pose({&none}, rng));
  EXPECT_FALSE(ground_pose({}, rng));
}

SceneMotionEstimate drive(const Eigen::Vector3d& linear_mps, double yaw_rate_radps,
                          const Eigen::Matrix3d& R_reference_road) {
  SceneMotionEstimate motion;
  motion.velocity.linear_mps = R_reference_road * linear_mps;
  motion.velocity.angular_radps = R_reference_road * Eigen::Vector3d(0.0, 0.0, yaw_rate_radps);
  motion.covariance = Matrix6d::Identity() * 1e-4;
  return motion;
}

TEST(HeadingOfTravel, IsThatOfTheVelocityInTheLevelledFrame) {
  Rng rng = test_rng();
  for (int round = 0; round < 100; ++round) {
    const GroundPose ground = random_mounting(rng);
    const Eigen::Matrix3d R = road_from_reference(ground).rotation.transpose();
    const double yaw_rad = rng.uniform(-kPi, kPi);
    std::vector<SceneMotionEstimate> motion;
    for (int i = 0; i < 5; ++i) {
      // One scene in reverse; one that stands; one that turns.
      const double speed_mps = i == 2 ? -3.0 : rng.uniform(2.0, 20.0);
      const double turned_rad = yaw_rad + 0.003 * rng.normal();
      motion.push_back(
          drive({speed_mps * std::cos(turned_rad), speed_mps * std::sin(turned_rad), 0}, 0.001, R));
    }
    motion.push_back(drive({0.1, 0.2, 0.0}, 0.0, R));
    motion.push_back(drive({-1.0, 5.0, 0.0}, 0.5, R));
    const std::optional<HeadingOfTravel> heading = heading_of_travel(motion, ground);
    ASSERT_TRUE(heading);
    EXPECT_EQ(heading->scenes, 5U);
    const double error_rad = std::remainder(heading->yaw_rad - yaw_rad, 2.0 * kPi);
    EXPECT_LT(std::abs(error_rad), 5.0 * heading->yaw_std_rad);
    EXPECT_LT(heading->yaw_std_rad, rad_from_deg(0.3));
  }
}

TEST(HeadingOfTravel, IsMissingIfTheRigStandsOrTurns) {
  const Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  EXPECT_FALSE(heading_of_travel({}, {}));
  EXPECT_FALSE(heading_of_travel({drive({0.5, 0, 0}, 0.0, R)}, {}));
  EXPECT_FALSE(heading_of_travel({drive({5.0, 0, 0}, 0.3, R)}, {}));
  EXPECT_TRUE(heading_of_travel({drive({5.0, 0, 0}, 0.0, R)}, {}));
}

}  // namespace
}  // namespace croon::test
