#include "framework/geometry/twist.hpp"

#include <gtest/gtest.h>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

Twist random_twist(Rng& rng, double turn_radps) {
  Twist twist;
  for (int axis = 0; axis < 3; ++axis) {
    twist.angular_radps(axis) = rng.uniform(-turn_radps, turn_radps);
    twist.linear_mps(axis) = rng.uniform(-20.0, 20.0);
  }
  return twist;
}

void expect_near_elements(const RigidTransform& a, const RigidTransform& b, double tolerance) {
  EXPECT_LT((a.rotation - b.rotation).norm(), tolerance);
  EXPECT_LT((a.translation - b.translation).norm(), tolerance);
}

TEST(Twist, MotionsOverTimesAddUp) {
  Rng rng = test::test_rng();
  for (const double turn : {0.0, 1e-6, 1e-3, 0.5, 3.0}) {
    for (int i = 0; i < 50; ++i) {
      const Twist twist = random_twist(rng, turn);
      const double a = rng.uniform(-1.0, 1.0), b = rng.uniform(-1.0, 1.0);
      expect_near_elements(motion_over(twist, a) * motion_over(twist, b), motion_over(twist, a + b),
                           1e-11);
      expect_near_elements(motion_over(twist, -a), motion_over(twist, a).inverse(), 1e-11);
    }
  }
}

TEST(Twist, TurnsByTheExponentialOfTheRotation) {
  Rng rng = test::test_rng(2);
  for (int i = 0; i < 1000; ++i) {
    const Twist twist = random_twist(rng, 1.0);
    const RigidTransform T = motion_over(twist, 1.0);
    EXPECT_LT((T.rotation - rotation_exp(twist.angular_radps)).norm(), 1e-15) << i;
  }
}

TEST(Twist, IsTheDerivativeOfTheMotion) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    const Twist twist = random_twist(rng, 2.0);
    constexpr double kStep_s = 1e-6;
    const RigidTransform T = motion_over(twist, kStep_s);
    EXPECT_LT((T.translation / kStep_s - twist.linear_mps).norm(), 1e-3);
    const Eigen::Vector3d turn(T.rotation(2, 1), T.rotation(0, 2), T.rotation(1, 0));
    EXPECT_LT((turn / kStep_s - twist.angular_radps).norm(), 1e-3);
  }
}

TEST(Twist, OfAFrameOnTheBodyMovesThatFrame) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    const Twist body = random_twist(rng, 2.0);
    const RigidTransform T_body_sensor = test::random_pose(rng, 3.0);
    const Twist sensor = velocity_in(T_body_sensor.inverse(), body);
    expect_near_elements(motion_over(body, 0.1) * T_body_sensor,
                         T_body_sensor * motion_over(sensor, 0.1), 1e-11);
  }
}

TEST(Twist, OfAnArcIsTheArc) {
  // A quarter of a circle with a radius of 10 m to the left, in a second.
  const double quarter = 2.0 * std::atan(1.0);
  const RigidTransform T = motion_over({{0, 0, quarter}, {10.0 * quarter, 0, 0}}, 1.0);
  EXPECT_LT((T.translation - Eigen::Vector3d(10.0, 10.0, 0.0)).norm(), 1e-12);
}

}  // namespace
}  // namespace croon
