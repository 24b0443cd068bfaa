#include "framework/registration/bundle_system.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

/// The corner of a room that two sensors see in two scenes, at two velocities.
struct Room {
  std::vector<std::shared_ptr<const Cloud>> clouds;
  std::vector<BundleScene> scenes;
  std::vector<InformedPose> start;
};

PointCloud corner_seen_from(const RigidTransform& T_common_sensor, Rng& rng) {
  PointCloud cloud;
  for (int i = 0; i < 3000; ++i) {
    Eigen::Vector3d point;
    for (double& part : point) part = rng.uniform(0.0, 4.0);
    point(i % 3) = 0.003 * rng.normal();
    cloud.points.push_back((T_common_sensor.inverse() * point).cast<float>());
  }
  return cloud;
}

Room room(Rng& rng) {
  Room made;
  made.start = {{RigidTransform()}, {test::random_pose(rng, 1.0)}};
  for (int s = 0; s < 2; ++s) {
    BundleScene& scene = made.scenes.emplace_back();
    scene.velocity.linear_mps = Eigen::Vector3d(10.0 * s, 1.0, 0.0);
    scene.velocity.angular_radps = Eigen::Vector3d(0.0, 0.0, 0.1 * s);
    scene.motion_covariance = 0.01 * Matrix6d::Identity();
    for (std::size_t k = 0; k < 2; ++k) {
      made.clouds.push_back(
          std::make_shared<const Cloud>(corner_seen_from(made.start[k].pose, rng), StreamKey(1)));
      SensorCloud& seen = scene.clouds.emplace_back();
      seen = {k, made.clouds.back().get()};
      for (std::size_t i = 0; i < seen.cloud->points().size(); ++i) {
        seen.times_s.push_back(rng.uniform(-0.05, 0.05));
      }
    }
  }
  return made;
}

/// The state after a step: six of the second sensor's pose, one of its clock, six of each velocity.
BundleState stepped(BundleState state, const Eigen::VectorXd& step) {
  state.poses[1] = croon::stepped(state.poses[1], step.head<6>());
  state.clock_offsets_s[1] += step(6);
  for (std::size_t s = 0; s < state.velocities.size(); ++s) {
    const auto at = static_cast<Eigen::Index>(7 + 6 * s);
    state.velocities[s] = croon::stepped(*state.velocities[s], step.segment<6>(at));
  }
  return state;
}

TEST(BundleSystem, HasTheGradientOfItsValueByPosesClocksAndVelocities) {
  Rng rng = test::test_rng();
  const Room made = room(rng);
  BundleOptions options;
  options.clock_offset_std_s = 0.05;
  BundleSystem system(made.scenes, made.start, options);
  system.find_planes(1);
  ASSERT_EQ(system.free_sensors().size(), 1U);
  Eigen::VectorXd off = Eigen::VectorXd::Zero(19);
  for (Eigen::Index i = 0; i < off.size(); ++i) off(i) = rng.uniform(-0.002, 0.002);
  system.set_state(stepped(system.state(), off));

  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(19);
  gradient.head<7>() = system.start_cost().gradient;
  for (std::size_t s = 0; s < 2; ++s) {
    const BlockSystem cost = system.scene_cost(s, system.planes()[s], true);
    gradient.head<7>() += cost.gradient.head<7>();
    gradient.segment<6>(static_cast<Eigen::Index>(7 + 6 * s)) = cost.gradient.tail<6>();
  }
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    constexpr double kStep = 1e-6;
    Eigen::VectorXd step = Eigen::VectorXd::Zero(gradient.size());
    step(i) = kStep;
    const double numeric = (system.value_in(stepped(system.state(), step)) -
                            system.value_in(stepped(system.state(), -step))) /
                           (2.0 * kStep);
    EXPECT_NEAR(gradient(i), numeric, 1e-3 * (std::abs(numeric) + 1.0)) << i;
  }
}

TEST(BundleSystem, AClockMovesASensorAlongTheVelocityOfTheScene) {
  Rng rng = test::test_rng();
  const Room made = room(rng);
  BundleOptions options;
  options.clock_offset_std_s = 0.05;
  const BundleSystem system(made.scenes, made.start, options);
  BundleState state = system.state();
  state.clock_offsets_s[1] = 0.02;
  for (std::size_t s = 0; s < 2; ++s) {
    const RigidTransform expected = motion_over(made.scenes[s].velocity, 0.02) * made.start[1].pose;
    const PoseError error = pose_error(system.rig_state(state, s).poses[1], expected);
    EXPECT_LT(error.rotation_rad, 1e-12);
    EXPECT_LT(error.translation_m, 1e-12);
  }
}

TEST(BundleSystem, LeavesOutASensorThatSharesTooFewPlanes) {
  Rng rng = test::test_rng(2);
  const Room made = room(rng);
  BundleOptions options;
  // A third sensor that sees little of the corner, from a start that is 2 cm off.
  Room more = made;
  InformedPose off = {test::random_pose(rng, 1.0)};
  for (BundleScene& scene : more.scenes) {
    PointCloud little = corner_seen_from(off.pose, rng);
    little.points.resize(40);
    more.clouds.push_back(std::make_shared<const Cloud>(std::move(little), StreamKey(2)));
    scene.clouds.push_back({2, more.clouds.back().get(), std::vector<double>(40, 0.0)});
  }
  off.pose.translation.x() += 0.02;
  more.start.push_back(off);

  BundleSystem without(made.scenes, made.start, options), with(more.scenes, more.start, options);
  BundleState moved = with.state();
  moved.poses[2].translation.y() += 0.1;
  with.set_state(moved);
  with.find_planes(1);
  without.find_planes(1);
  EXPECT_EQ(with.free_sensors(), without.free_sensors());
  EXPECT_LT(with.planes_of_sensors()[2], options.min_planes);
  EXPECT_EQ(with.state().poses[2].translation, off.pose.translation);
  for (std::size_t s = 0; s < with.planes().size(); ++s) {
    // The others are where they would be without it.
    ASSERT_EQ(with.planes()[s].size(), without.planes()[s].size());
    for (std::size_t i = 0; i < with.planes()[s].size(); ++i) {
      const PlanePatch &patch = with.planes()[s][i], &alone = without.planes()[s][i];
      ASSERT_EQ(patch.views.size(), 2U);
      EXPECT_EQ(patch.own_cost, alone.own_cost);
      for (const PlanePatch::View& view : patch.views) EXPECT_NE(view.sensor, 2U);
    }
  }
}

}  // namespace
}  // namespace croon
