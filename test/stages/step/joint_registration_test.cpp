#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "framework/base/angles.hpp"
#include "framework/simulation/rig.hpp"
#include "framework/simulation/sensor_model.hpp"
#include "framework/simulation/simulated_scene.hpp"
#include "framework/stage/given_motions.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/rig_step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

std::shared_ptr<const simulation::Recipe> recipe(const simulation::Noise& noise) {
  auto made = std::make_shared<simulation::Recipe>();
  made->rig = simulation::rigs().front().second;
  made->noise = noise;
  made->seed = 8101;
  return made;
}

std::shared_ptr<const Cloud> thinned(PointCloud cloud) {
  const auto thin =
      test::stage<Preprocessor>(R"({"type": "voxel_downsample", "leaf_size_m": 0.2})");
  return std::make_shared<const Cloud>(thin->apply(cloud), StreamKey(1));
}

/// The left and the right sensor in the scenes `indices`, with starts near the truth.
struct DrivingRig {
  std::vector<RigEstimate> estimates;
  std::map<std::string, RigidTransform> truth;  ///< By sensor.
  std::map<std::string, Twist> velocities;      ///< Of the target, by scene.
};

DrivingRig rig_of(const simulation::Noise& noise, const std::vector<std::uint64_t>& indices,
                  bool with_times = true) {
  DrivingRig rig;
  Rng rng = test::test_rng();
  const auto made = recipe(noise);
  for (const std::uint64_t index : indices) {
    const simulation::SimulatedScene scene(made, index);
    const std::string name = std::to_string(index);
    rig.velocities[name] = scene.velocity_of("top");
    const auto scan = [&](const std::string& sensor) {
      PointCloud cloud = scene.scan_of(sensor);
      if (!with_times) cloud.channels.clear();
      return thinned(std::move(cloud));
    };
    const auto target = scan("top");
    for (const auto& [sensor, mounting] : made->rig.sensors) {
      if (sensor != "left" && sensor != "right") continue;
      rig.truth[sensor] = mounting.T_reference_sensor();
      rig.estimates.push_back({name, "top", sensor, {}});
      Estimate& estimate = rig.estimates.back().estimate;
      estimate.target = target;
      estimate.source = scan(sensor);
      estimate.T_target_source = test::pose_near(rng, rig.truth[sensor], 0.5, 0.1);
    }
  }
  return rig;
}

/// The indices of the first scenes of the recipe that are faster than 4 m/s.
std::vector<std::uint64_t> moving_scenes(std::size_t count) {
  std::vector<std::uint64_t> indices;
  for (std::uint64_t index = 0; indices.size() < count; ++index) {
    const simulation::SimulatedScene scene(recipe(simulation::real_noise()), index);
    if (scene.world().car.motion.speed_mps > 4.0) indices.push_back(index);
  }
  return indices;
}

void adjust_jointly(std::vector<RigEstimate>& rig, const std::string& parameters = "") {
  Rng rng = test::test_rng();
  const auto step = test::stage<Step>(R"({"step": "joint_registration")" + parameters + "}");
  dynamic_cast<const RigStep&>(*step).adjust(rig, rng);
}

// joint_deskew_test.cpp tests where the points are then.
TEST(JointRegistration, FindsThePosesAndTheVelocityOfADrivingRig) {
  DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(2));
  const std::vector<RigEstimate> before = rig.estimates;
  adjust_jointly(rig.estimates);
  for (std::size_t i = 0; i < rig.estimates.size(); ++i) {
    const RigEstimate& one = rig.estimates[i];
    const Estimate &estimate = one.estimate, &start = before[i].estimate;
    SCOPED_TRACE(one.scene + one.source);
    ASSERT_EQ(one.failure, "");
    const PoseError error = pose_error(estimate.T_target_source, rig.truth[one.source]);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.4);
    EXPECT_LT(error.translation_m, 0.06);

    const Twist& truth = rig.velocities[one.scene];
    const Twist& found = estimate.extras.get(kMotion);
    EXPECT_LT((found.linear_mps - truth.linear_mps).norm(), 0.8);
    Vector6d off;
    off << found.angular_radps - truth.angular_radps, found.linear_mps - truth.linear_mps;
    const Matrix6d& covariance = estimate.extras.get(kMotionCovariance);
    for (int k = 0; k < 6; ++k) {
      const double std = std::sqrt(covariance(k, k));
      // Along x, the stated standard deviation of one of the scenes is too small.
      EXPECT_LT(std::abs(off(k)), (k == 3 ? 6.0 : 5.0) * std) << k;
      EXPECT_LT(std, k < 3 ? rad_from_deg(10.0) : 2.0) << k;
    }
    EXPECT_EQ(test::diagnostic(estimate, "vx_mps"), found.linear_mps.x());
    EXPECT_EQ(test::diagnostic(estimate, "vx_std_mps"), std::sqrt(covariance(3, 3)));
    EXPECT_EQ(test::diagnostic(estimate, "yaw_rate_degps"), deg_from_rad(found.angular_radps.z()));
    EXPECT_EQ(test::diagnostic(estimate, "yaw_rate_std_degps"),
              deg_from_rad(std::sqrt(covariance(2, 2))));

    // All sensors of a scene have one target and one velocity.
    const Estimate& first = rig.estimates[i - i % 2].estimate;
    EXPECT_EQ(covariance, first.extras.get(kMotionCovariance));
    EXPECT_EQ(estimate.target, first.target);
    EXPECT_NE(estimate.target, start.target);
    EXPECT_EQ(estimate.source->points().size(), start.source->points().size());
    EXPECT_EQ(times_s(estimate.source->with_channels()), times_s(start.source->with_channels()));
  }
}

/// A rig of which the right sensor starts `off` the truth, and the left one alone.
std::array<DrivingRig, 2> rig_with_a_wrong_start(const Vector6d& off) {
  DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(1));
  DrivingRig left = rig;
  left.estimates.pop_back();
  Estimate& right = rig.estimates.back().estimate;
  right.set_pose(moved(rig.truth["right"], off));
  for (DrivingRig* const one : {&rig, &left}) adjust_jointly(one->estimates);
  return {std::move(rig), std::move(left)};
}

TEST(JointRegistration, RejectsASensorAtAWrongPoseWhichDoesNotMisleadTheVelocity) {
  const auto [rig, left] =
      rig_with_a_wrong_start((Vector6d() << 0.0, 0.0, kPi / 2, 3.0, 3.0, 0.0).finished());
  const Estimate& right = rig.estimates.back().estimate;
  ASSERT_TRUE(right.rejection);
  EXPECT_EQ(right.rejection->rfind("at the initial pose, the share of points in free space", 0),
            0U);
  const Twist& alone = left.estimates.front().estimate.extras.get(kMotion);
  EXPECT_EQ(vector_of(right.extras.get(kMotion)), vector_of(alone));
}

TEST(JointRegistration, RegistersASensorAtAWrongPoseWithTheVelocityOfTheOthers) {
  const auto [rig, left] =
      rig_with_a_wrong_start((Vector6d() << 0.0, 0.0, 0.0, 1.0, 0.0, 0.0).finished());
  const Estimate& right = rig.estimates.back().estimate;
  EXPECT_FALSE(right.rejection) << *right.rejection;
  const PoseError error = pose_error(right.T_target_source, rig.truth.at("right"));
  EXPECT_LT(deg_from_rad(error.rotation_rad), 0.4);
  EXPECT_LT(error.translation_m, 0.06);
  const Twist& alone = left.estimates.front().estimate.extras.get(kMotion);
  EXPECT_EQ(vector_of(right.extras.get(kMotion)), vector_of(alone));
  EXPECT_EQ(right.target, rig.estimates.front().estimate.target);
}

TEST(JointRegistration, RejectsASceneInWhichAnotherSpeedIsAsGood) {
  DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(1));
  DrivingRig strict = rig;
  for (RigEstimate& one : strict.estimates) one.estimate.rejection = "before: no";
  // Every speed is in doubt, and no lead over others is enough.
  const std::string in_doubt = R"(, "max_speed_std_mps": 0, "certain_shift_m": 0)";
  adjust_jointly(rig.estimates, in_doubt);
  adjust_jointly(strict.estimates, in_doubt + R"(, "min_speed_lead": 1000)");
  for (std::size_t i = 0; i < rig.estimates.size(); ++i) {
    EXPECT_FALSE(rig.estimates[i].estimate.rejection);
    ASSERT_TRUE(strict.estimates[i].estimate.rejection);
    // The reason of a step before stays.
    EXPECT_EQ(strict.estimates[i].estimate.rejection->rfind("before: no; ", 0), 0U);
    EXPECT_NE(strict.estimates[i].estimate.rejection->find("below 1000.00"), std::string::npos);
  }
}

/// Moves the first point of the source to `x_m`.
void move_first_point(Estimate& estimate, float x_m) {
  PointCloud cloud = estimate.source->with_channels();
  cloud.points.front().x() = x_m;
  estimate.source = std::make_shared<const Cloud>(std::move(cloud), StreamKey(1));
}

TEST(JointRegistration, ACloudThatDefeatsItFailsAlone) {
  DrivingRig rig = rig_of(simulation::real_still_noise(), {0, 1});
  rig.estimates[0].estimate.source = std::make_shared<const Cloud>(PointCloud(), StreamKey(1));
  move_first_point(rig.estimates[3].estimate, 1e30F);
  adjust_jointly(rig.estimates);
  EXPECT_NE(rig.estimates[0].failure.find("empty"), std::string::npos);
  EXPECT_EQ(rig.estimates[1].failure, "");
  EXPECT_EQ(rig.estimates[2].failure, "");
  EXPECT_EQ(rig.estimates[3].failure.rfind("a point at (1e+30, ", 0), 0U);
}

TEST(JointRegistration, ACloudThatCannotBeThinnedFailsAlone) {
  DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(2));
  // No step refuses a point at 60 km, but leaves of 0.1 mm do not reach it.
  move_first_point(rig.estimates.front().estimate, 6e4F);
  adjust_jointly(rig.estimates,
                 R"(, "thinning": {"type": "voxel_downsample", "leaf_size_m": 1e-4})");
  for (const RigEstimate& one : rig.estimates) {
    EXPECT_EQ(one.failure.empty(), &one != &rig.estimates.front()) << one.failure;
    EXPECT_FALSE(one.estimate.information);
  }
}

/// The rig after known_velocity with velocities that are too small by `error_mps` along x, and
/// say that they have the standard deviation `std` in m/s and rad/s.
void remove_known_velocity(DrivingRig& rig, double error_mps, double std = 0.1) {
  GivenMotions motions;
  for (const auto& [scene, velocity] : rig.velocities) {
    motions[scene] = {velocity, Vector6d::Constant(std)};
    motions[scene].velocity.linear_mps.x() -= error_mps;
  }
  const auto step = test::stage<Step>(R"({"step": "known_velocity", "file": "v.csv"})");
  const auto known = dynamic_cast<const GivenMotionStep&>(*step).with(motions);
  Rng rng = test::test_rng();
  dynamic_cast<const RigStep&>(*known).adjust(rig.estimates, rng);
}

TEST(JointRegistration, LeavesAVelocityThatIsKnown) {
  DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(1));
  remove_known_velocity(rig, 0.0);
  const auto before = rig.estimates;
  adjust_jointly(rig.estimates, R"(, "motion": false)");
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Estimate& estimate = rig.estimates[i].estimate;
    EXPECT_EQ(estimate.target, before[i].estimate.target);
    EXPECT_EQ(vector_of(estimate.extras.get(kMotion)),
              vector_of(before[i].estimate.extras.get(kMotion)));
    EXPECT_EQ(estimate.extras.get(kMotionCovariance),
              before[i].estimate.extras.get(kMotionCovariance));
    EXPECT_NEAR(test::diagnostic(estimate, "speed_std_mps"), std::hypot(0.1, 0.1), 1e-9);
  }
}

TEST(JointRegistration, EstimatesWhatRemainsOfAVelocityThatIsKnown) {
  DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(1));
  remove_known_velocity(rig, 3.0, 3.0);
  adjust_jointly(rig.estimates);
  for (const RigEstimate& one : rig.estimates) {
    const Twist& found = one.estimate.extras.get(kMotion);
    EXPECT_LT((found.linear_mps - rig.velocities[one.scene].linear_mps).norm(), 0.8) << one.scene;
    EXPECT_EQ(test::diagnostic(one.estimate, "vx_mps"), found.linear_mps.x());
  }
}

TEST(JointRegistration, StaysNearAVelocityThatIsKnownWell) {
  DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(1));
  remove_known_velocity(rig, 3.0, 1e-3);
  const Twist given = rig.estimates.front().estimate.extras.get(kMotion);
  adjust_jointly(rig.estimates);
  for (const RigEstimate& one : rig.estimates) {
    const Twist& found = one.estimate.extras.get(kMotion);
    EXPECT_LT((found.linear_mps - given.linear_mps).norm(), 0.01);
    const Matrix6d& covariance = one.estimate.extras.get(kMotionCovariance);
    for (int k = 0; k < 6; ++k) EXPECT_LT(std::sqrt(covariance(k, k)), 0.01) << k;
  }
}

TEST(JointRegistration, KnowsTheVelocityBetterWithOneThatIsGiven) {
  DrivingRig alone = rig_of(simulation::real_noise(), moving_scenes(1));
  DrivingRig rig = alone;
  remove_known_velocity(rig, 0.0, 0.1);
  adjust_jointly(alone.estimates);
  adjust_jointly(rig.estimates);
  const auto std_mps = [](const DrivingRig& of) {
    const Matrix6d& covariance = of.estimates.front().estimate.extras.get(kMotionCovariance);
    return std::sqrt(covariance.block<3, 3>(3, 3).trace());
  };
  EXPECT_LT(std_mps(rig), std_mps(alone));
  EXPECT_GT(std_mps(rig), 0.0);
}

TEST(JointRegistration, ComparesWithOtherSpeedsOfTheCarAndNotOfWhatRemains) {
  // A start at the speed that was found leads to the same state; one at another speed stays where
  // it is if only points within 0.1 m correspond, and no lead over that is enough.
  const auto is_rejected_beside = [](double speed_mps) {
    DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(1));
    for (RigEstimate& one : rig.estimates) one.estimate.T_target_source = rig.truth[one.source];
    remove_known_velocity(rig, 0.0, 30.0);
    adjust_jointly(rig.estimates,
                   R"(, "max_speed_std_mps": 0, "certain_shift_m": 0, "min_speed_lead": 1000,
                       "patch_kernel_m": 0, "coarse_distances_m": [0.1], "max_distances_m": [0.1],
                       "other_speeds_mps": [)" +
                       std::to_string(speed_mps) + "]");
    return rig.estimates.front().estimate.rejection.has_value();
  };
  const DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(1));
  const Eigen::Vector3d velocity_mps = rig.velocities.begin()->second.linear_mps;
  EXPECT_FALSE(is_rejected_beside(velocity_mps.head<2>().norm()));
  EXPECT_TRUE(is_rejected_beside(-30.0));
}

TEST(JointRegistration, LeavesAVelocityThatIsCertain) {
  DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(1));
  remove_known_velocity(rig, 0.0, 0.0);
  const auto before = rig.estimates;
  adjust_jointly(rig.estimates);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(rig.estimates[i].estimate.target, before[i].estimate.target);
    EXPECT_EQ(vector_of(rig.estimates[i].estimate.extras.get(kMotion)),
              vector_of(before[i].estimate.extras.get(kMotion)));
  }
}

TEST(JointRegistration, LeavesTheCloudsOfAStandingRig) {
  DrivingRig rig = rig_of(simulation::real_still_noise(), {0});
  const auto before = rig.estimates;
  adjust_jointly(rig.estimates);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(rig.estimates[i].estimate.target, before[i].estimate.target);
    EXPECT_EQ(rig.estimates[i].estimate.source, before[i].estimate.source);
    EXPECT_TRUE(rig.estimates[i].estimate.extras.get(kMotion).linear_mps.isZero());
  }
}

TEST(JointRegistration, TakesCloudsWithoutTimesAsStanding) {
  DrivingRig rig = rig_of(simulation::real_still_noise(), {0}, false);
  adjust_jointly(rig.estimates);
  for (const RigEstimate& one : rig.estimates) {
    ASSERT_EQ(one.failure, "");
    EXPECT_EQ(one.estimate.extras.find(kMotion), nullptr);
    const PoseError error = pose_error(one.estimate.T_target_source, rig.truth[one.source]);
    EXPECT_LT(error.translation_m, 0.05) << one.source;
  }
}

TEST(JointRegistration, TimesThatItDoesNotAskForDoNotCount) {
  // A run reads the channel time for all variants if one of them needs it.
  DrivingRig with = rig_of(simulation::real_noise(), {0});
  DrivingRig without = rig_of(simulation::real_noise(), {0}, false);
  for (DrivingRig* const rig : {&with, &without}) {
    adjust_jointly(rig->estimates, R"(, "motion": false)");
  }
  for (std::size_t i = 0; i < with.estimates.size(); ++i) {
    ASSERT_EQ(with.estimates[i].failure, "");
    const RigidTransform& a = with.estimates[i].estimate.T_target_source;
    const RigidTransform& b = without.estimates[i].estimate.T_target_source;
    EXPECT_EQ(a.rotation, b.rotation);
    EXPECT_EQ(a.translation, b.translation);
  }
}

TEST(JointRegistration, GivesASensorOnePoseInAllScenes) {
  DrivingRig rig = rig_of(simulation::real_noise(), moving_scenes(2));
  for (RigEstimate& one : rig.estimates) {
    one.estimate.T_target_source =
        rig.estimates[one.source == "left" ? 0 : 1].estimate.T_target_source;
  }
  adjust_jointly(rig.estimates, R"(, "poses": "common")");
  ASSERT_EQ(rig.estimates.size(), 4U);
  for (const std::size_t k : {0U, 1U}) {
    const RigidTransform& first = rig.estimates[k].estimate.T_target_source;
    EXPECT_EQ(first.translation, rig.estimates[k + 2].estimate.T_target_source.translation);
    EXPECT_EQ(first.rotation, rig.estimates[k + 2].estimate.T_target_source.rotation);
    EXPECT_LT(pose_error(first, rig.truth[rig.estimates[k].source]).translation_m, 0.05);
  }
}

TEST(JointRegistration, FailsTheSensorThatIsFarFromAllSurfacesAlone) {
  DrivingRig rig = rig_of(simulation::real_still_noise(), {0});
  rig.estimates[0].estimate.T_target_source.translation.z() += 500.0;
  adjust_jointly(rig.estimates);
  EXPECT_NE(rig.estimates[0].failure.find("0 points correspond"), std::string::npos);
  ASSERT_EQ(rig.estimates[1].failure, "");
  const PoseError error =
      pose_error(rig.estimates[1].estimate.T_target_source, rig.truth[rig.estimates[1].source]);
  EXPECT_LT(error.translation_m, 0.05);
}

TEST(JointRegistration, StartsACommonPoseWhereMostScenesAgree) {
  DrivingRig rig = rig_of(simulation::real_still_noise(), {0, 1, 2});
  rig.estimates[0].estimate.T_target_source.translation.x() += 8.0;
  adjust_jointly(rig.estimates, R"(, "poses": "common", "motion": false)");
  for (const RigEstimate& one : rig.estimates) {
    EXPECT_LT(pose_error(one.estimate.T_target_source, rig.truth[one.source]).translation_m, 0.05);
  }
}

TEST(JointRegistration, HasNoClockOffsetsAtRest) {
  const std::string message = test::input_error([] {
    test::build_stage("step", R"({"step": "joint_registration", "motion": false,
                                  "clock_offset_std_s": 0.1})");
  });
  EXPECT_NE(message.find("clock_offset_std_s must be 0 if motion is false"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace croon
