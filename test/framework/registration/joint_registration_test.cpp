#include "framework/registration/joint_registration.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/spatial/deskew.hpp"
#include "test/support/driven_scan.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

constexpr int kRoomPoints = 2000;

/// Points on the walls, the floor and the ceiling of a room, in the target's frame.
Points random_room(Rng& rng) {
  const Eigen::Vector3d half_m(6.0, 4.0, 2.5);
  Points room;
  for (int i = 0; i < kRoomPoints; ++i) {
    Eigen::Vector3d point = half_m.cwiseProduct(test::random_point(rng, 1.0));
    const int axis = i % 3;
    point(axis) = rng.uniform() < 0.5 ? half_m(axis) : -half_m(axis);
    room.push_back(point.cast<float>());
  }
  return room;
}

/// When a sensor that turns once in 0.1 s, about z or against it, looks at each of `points`.
std::vector<double> looking_times_s(const Points& points, double begin_s, float sense) {
  std::vector<double> times;
  for (const Eigen::Vector3f& point : points) {
    times.push_back(begin_s + 0.05 * (1.0 + std::atan2(sense * point.y(), point.x()) / kPi));
  }
  return times;
}

/// A room that a driving rig of two sensors measures. The clock of the sensor shows `late_s` less
/// than the target's.
JointScene driven_room(Rng& rng, const RigidTransform& T_target_sensor, const Twist& velocity,
                       double late_s = 0.0) {
  const Points of_target = random_room(rng);
  const Points of_sensor = transformed(random_room(rng), T_target_sensor.inverse());
  const std::vector<double> target_s = looking_times_s(of_target, 0.0, 1.0F);
  std::vector<double> sensor_s = looking_times_s(of_sensor, 0.02, -1.0F);
  JointScene scene;
  scene.reference_s = span_of(target_s).middle_s();
  scene.is_moving = true;
  const auto scan = [&](const Points& points, const std::vector<double>& times_s,
                        const RigidTransform& T) {
    return std::make_shared<const Cloud>(
        test::driven_scan(points, times_s, scene.reference_s, velocity, T), StreamKey(1));
  };
  scene.target = {scan(of_target, target_s, {}), target_s};
  const auto cloud = scan(of_sensor, sensor_s, T_target_sensor);
  for (double& time_s : sensor_s) time_s -= late_s;
  scene.sources = {{0, {cloud, sensor_s}}};
  return scene;
}

JointRegistration registered(const std::vector<JointScene>& scenes, const RigidTransform& start,
                             double clock_offset_std_s = 0.0) {
  JointOptions options;
  options.max_distances_m = {1.0, 0.5, 0.3};
  options.clock_offset_std_s = clock_offset_std_s;
  return register_jointly(scenes, {{start}, {0.0}, std::vector<Twist>(scenes.size())}, options);
}

void expect_near(const RigidTransform& T, const RigidTransform& truth) {
  const PoseError error = pose_error(T, truth);
  EXPECT_LT(deg_from_rad(error.rotation_rad), 0.3);
  EXPECT_LT(error.translation_m, 0.03);
}

/// A sensor inside the room, turned anyhow.
RigidTransform any_mounting(Rng& rng) { return test::random_pose(rng, 1.0); }

Twist any_velocity(Rng& rng) {
  return {0.2 * test::random_point(rng, 1.0),
          {rng.uniform(-10.0, 10.0), rng.uniform(-1.0, 1.0), rng.uniform(-0.2, 0.2)}};
}

TEST(RegisterJointly, FindsAnyPoseAndVelocityInARoom) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test::test_rng(seed);
    const RigidTransform truth = any_mounting(rng);
    const Twist velocity = any_velocity(rng);
    const JointScene scene = driven_room(rng, truth, velocity);
    const JointRegistration found = registered({scene}, test::pose_near(rng, truth, 1.0, 0.1));
    expect_near(found.state.T_target_sensor.front(), truth);
    const Twist& motion = found.state.velocities.front();
    EXPECT_LT((motion.linear_mps - velocity.linear_mps).norm(), 0.5);
    EXPECT_LT((motion.angular_radps - velocity.angular_radps).norm(), 0.1);
    EXPECT_GT(found.correspondences.front().front(), kRoomPoints / 2);
  }
}

TEST(RegisterJointly, FollowsAnotherFrameOfTheSensor) {
  Rng rng = test::test_rng(5);
  const RigidTransform truth = any_mounting(rng);
  JointScene scene = driven_room(rng, truth, any_velocity(rng));
  const RigidTransform start = test::pose_near(rng, truth, 1.0, 0.1);
  const RigidTransform T = registered({scene}, start).state.T_target_sensor.front();
  const RigidTransform T_other_sensor = test::random_pose(rng, 2.0);
  TimedScan& scan = scene.sources.front().scan;
  scan.cloud = std::make_shared<const Cloud>(transformed(scan.cloud->points(), T_other_sensor),
                                             StreamKey(1));
  const JointRegistration other = registered({scene}, start * T_other_sensor.inverse());
  const PoseError error = pose_error(other.state.T_target_sensor.front() * T_other_sensor, T);
  EXPECT_LT(deg_from_rad(error.rotation_rad), 0.1);
  EXPECT_LT(error.translation_m, 0.01);
}

TEST(RegisterJointly, FindsTheOffsetOfAClockFromScenesOfDifferentVelocities) {
  constexpr double kLate_s = 0.03;
  Rng rng = test::test_rng(6);
  const RigidTransform truth = any_mounting(rng);
  const std::vector<Twist> velocities = {
      {}, {{0.01, -0.02, 0.2}, {8.0, -0.5, 0.1}}, {{0.0, 0.0, -0.1}, {14.0, 0.3, 0.0}}};
  std::vector<JointScene> scenes;
  for (const Twist& velocity : velocities) {
    scenes.push_back(driven_room(rng, truth, velocity, kLate_s));
  }
  const JointState found = registered(scenes, test::pose_near(rng, truth, 1.0, 0.1), 0.1).state;
  EXPECT_NEAR(found.clock_offsets_s.front(), kLate_s, 0.005);
  expect_near(found.T_target_sensor.front(), truth);
}

}  // namespace
}  // namespace croon
