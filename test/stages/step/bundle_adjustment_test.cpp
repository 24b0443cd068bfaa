#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/simulation/rig.hpp"
#include "framework/simulation/sensor_model.hpp"
#include "framework/simulation/simulated_scene.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/rig_step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;

/// All sensors of a standing car in its first scenes, with starts near the truth.
struct StandingRig {
  std::vector<RigEstimate> estimates;
  std::map<std::string, RigidTransform> truth;  ///< By sensor.
};

/// With scenes of the kind `kind` alone, if it is given.
StandingRig standing_rig(std::uint64_t scenes, std::optional<simulation::SceneKind> kind = {}) {
  StandingRig rig;
  Rng rng = test::test_rng();
  auto recipe = std::make_shared<simulation::Recipe>();
  recipe->rig = simulation::rigs().front().second;
  recipe->noise = simulation::real_still_noise();
  recipe->seed = 8201;
  if (kind) recipe->mix = simulation::mix_of(*kind);
  for (std::uint64_t index = 0; index < scenes; ++index) {
    const simulation::SimulatedScene scene(recipe, index);
    const auto scan = [&](const std::string& sensor) {
      PointCloud cloud;
      for (const Eigen::Vector3f& point : scene.scan_of(sensor).points) {
        if (point.norm() > 1.0F) cloud.points.push_back(point);
      }
      return std::make_shared<const Cloud>(std::move(cloud), StreamKey(1));
    };
    const auto target = scan("top");
    for (const auto& [sensor, mounting] : recipe->rig.sensors) {
      if (sensor == "top") continue;
      rig.truth[sensor] = mounting.T_reference_sensor();
      rig.estimates.push_back({std::to_string(index), "top", sensor, {}});
      Estimate& estimate = rig.estimates.back().estimate;
      estimate.target = target;
      estimate.source = scan(sensor);
      estimate.T_target_source = test::pose_near(rng, rig.truth[sensor], 0.3, 0.05);
    }
  }
  return rig;
}

void adjust_bundle(std::vector<RigEstimate>& rig,
                   const std::string& step_json = R"({"step": "bundle_adjustment"})") {
  Rng rng = test::test_rng();
  const auto step = test::stage<Step>(step_json);
  dynamic_cast<const RigStep&>(*step).adjust(rig, rng);
}

TEST(BundleAdjustment, FindsOnePoseForEachSensorInAllScenesAndHowWellItIsConstrained) {
  StandingRig rig = standing_rig(2);
  adjust_bundle(rig.estimates);
  std::map<std::string, RigidTransform> found;
  for (const RigEstimate& one : rig.estimates) {
    ASSERT_EQ(one.failure, "");
    const RigidTransform& T = one.estimate.T_target_source;
    const PoseError error = pose_error(T, rig.truth[one.source]);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.02) << one.source;
    EXPECT_LT(error.translation_m, 0.005) << one.source;
    const RigidTransform& first = found.emplace(one.source, T).first->second;
    EXPECT_EQ(first.rotation, T.rotation);
    EXPECT_EQ(first.translation, T.translation);
    ASSERT_TRUE(one.estimate.covariance);
    const PoseCovariance& covariance = *one.estimate.covariance;
    EXPECT_TRUE(is_covariance(covariance.matrix));
    for (int dof = 0; dof < 6; ++dof) {
      EXPECT_EQ(covariance.dofs[static_cast<std::size_t>(dof)], Observability::determined);
      EXPECT_LT(std::abs(error.dof(dof)), 5.0 * std::sqrt(covariance.matrix(dof, dof)));
    }
  }
}

TEST(BundleAdjustment, FlatGroundHoldsNeitherXNorYNorYaw) {
  Rng rng = test::test_rng();
  const auto ground = [&](double height_m) {
    PointCloud cloud;
    for (int i = 0; i < 20000; ++i) {
      Eigen::Vector3d point;
      for (const int axis : {0, 1}) point(axis) = rng.uniform(-15.0, 15.0);
      point.z() = 0.02 * rng.normal() - height_m;
      cloud.points.push_back(point.cast<float>());
    }
    return std::make_shared<const Cloud>(std::move(cloud), StreamKey(1));
  };
  Estimate estimate;
  estimate.target = ground(2.0);
  estimate.source = ground(1.0);
  estimate.T_target_source.translation = {0.0, 0.0, -0.95};
  const Estimate found =
      test::stage<Step>(R"({"step": "bundle_adjustment"})")->advance(estimate, rng);
  EXPECT_NEAR(found.T_target_source.translation.z(), -1.0, 0.001);
  ASSERT_TRUE(found.covariance);
  for (const Dof dof : {Dof::x, Dof::y, Dof::yaw}) {
    EXPECT_NE(found.covariance->dofs[static_cast<std::size_t>(dof)], Observability::determined);
  }
  for (const Dof dof : {Dof::roll, Dof::pitch, Dof::z}) {
    EXPECT_EQ(found.covariance->dofs[static_cast<std::size_t>(dof)], Observability::determined);
  }
}

TEST(BundleAdjustment, ScenesOfWhichNoneHoldsADirectionDoNotHoldItTogether) {
  using simulation::SceneKind;
  const std::map<SceneKind, std::vector<Dof>> not_held = {{SceneKind::empty, {Dof::x, Dof::yaw}},
                                                          {SceneKind::corridor, {Dof::x}}};
  for (const auto& [kind, dofs] : not_held) {
    StandingRig rig = standing_rig(2, kind);
    adjust_bundle(rig.estimates);
    for (const RigEstimate& one : rig.estimates) {
      ASSERT_TRUE(one.estimate.covariance) << one.failure;
      for (const Dof dof : dofs) {
        EXPECT_NE(one.estimate.covariance->dofs[static_cast<std::size_t>(dof)],
                  Observability::determined)
            << static_cast<int>(kind) << one.source;
      }
      for (const Dof dof : {Dof::roll, Dof::pitch, Dof::z}) {
        EXPECT_EQ(one.estimate.covariance->dofs[static_cast<std::size_t>(dof)],
                  Observability::determined)
            << static_cast<int>(kind) << one.source << static_cast<int>(dof);
      }
    }
  }
}

TEST(BundleAdjustment, WhatARegistrationHoldsPlanesNeedNotHold) {
  StandingRig rig = standing_rig(1, simulation::SceneKind::corridor);
  for (RigEstimate& one : rig.estimates) {
    one.estimate.T_target_source = rig.truth[one.source];
    one.estimate.covariance = PoseCovariance();
    one.estimate.covariance->matrix = 1e-8 * Matrix6d::Identity();
  }
  adjust_bundle(rig.estimates);
  for (const RigEstimate& one : rig.estimates) {
    for (const Observability word : one.estimate.covariance->dofs) {
      EXPECT_EQ(word, Observability::determined);
    }
  }
}

TEST(BundleAdjustment, ASensorIsHeldByOthersThanTheReference) {
  StandingRig rig = standing_rig(1);
  // The reference keeps nothing near behind it, where the sensor at the back looks.
  PointCloud far;
  for (const Eigen::Vector3f& point : rig.estimates.front().estimate.target->points()) {
    if (point.norm() > 15.0F || point.x() > 0.0F) far.points.push_back(point);
  }
  const auto target = std::make_shared<const Cloud>(std::move(far), StreamKey(1));
  for (RigEstimate& one : rig.estimates) one.estimate.target = target;
  std::vector<RigEstimate> alone;
  for (const RigEstimate& one : rig.estimates) {
    if (one.source == "back") alone.push_back(one);
  }
  adjust_bundle(rig.estimates);
  adjust_bundle(alone);
  const auto error_m = [&](const RigEstimate& one) {
    return pose_error(one.estimate.T_target_source, rig.truth["back"]).translation_m;
  };
  for (const RigEstimate& one : rig.estimates) {
    if (one.source != "back") continue;
    EXPECT_LT(error_m(one), 0.02);
    EXPECT_EQ(alone.front().failure, "");
    EXPECT_LT(error_m(one), error_m(alone.front()));
  }
}

/// The estimate of `sensor`.
RigEstimate& of_sensor(StandingRig& rig, const std::string& sensor) {
  return *std::find_if(rig.estimates.begin(), rig.estimates.end(),
                       [&](const RigEstimate& one) { return one.source == sensor; });
}

TEST(BundleAdjustment, ARejectedPoseTakesNoPart) {
  StandingRig rig = standing_rig(1), without = rig;
  Estimate& astray = of_sensor(rig, "left").estimate;
  astray.T_target_source.translation.x() += 3.0;
  astray.rejection = "astray";
  const RigidTransform before = astray.T_target_source;
  without.estimates.erase(without.estimates.begin() +
                          (&of_sensor(without, "left") - without.estimates.data()));
  adjust_bundle(rig.estimates);
  adjust_bundle(without.estimates);
  EXPECT_EQ(astray.T_target_source.translation, before.translation);
  EXPECT_EQ(astray.rejection, "astray");
  for (const RigEstimate& one : without.estimates) {
    EXPECT_EQ(one.estimate.T_target_source.translation,
              of_sensor(rig, one.source).estimate.T_target_source.translation);
  }
}

TEST(BundleAdjustment, ACloudThatDefeatsItFailsAlone) {
  StandingRig rig = standing_rig(1);
  RigEstimate& stray = of_sensor(rig, "left");
  PointCloud cloud = stray.estimate.source->with_channels();
  cloud.points.front().x() = 1e30F;
  stray.estimate.source = std::make_shared<const Cloud>(std::move(cloud), StreamKey(1));
  adjust_bundle(rig.estimates);
  EXPECT_THAT(stray.failure, HasSubstr("m exceeds the maximum coordinate of 1e+06 m"));
  for (const RigEstimate& one : rig.estimates) {
    EXPECT_EQ(one.failure.empty(), &one != &stray) << one.source;
  }
}

TEST(BundleAdjustment, ASensorThatWouldMoveFarIsRejectedAndTheOthersDoWithoutIt) {
  StandingRig rig = standing_rig(1);
  for (RigEstimate& one : rig.estimates) one.estimate.T_target_source = rig.truth[one.source];
  Estimate& astray = of_sensor(rig, "left").estimate;
  astray.T_target_source.translation.z() += 0.2;
  const RigidTransform before = astray.T_target_source;
  adjust_bundle(rig.estimates, R"({"step": "bundle_adjustment", "max_correction_m": 0.15})");
  ASSERT_TRUE(astray.rejection);
  EXPECT_THAT(*astray.rejection, HasSubstr("above 180.000 or 0.150"));
  EXPECT_EQ(astray.T_target_source.translation, before.translation);
  for (RigEstimate& one : rig.estimates) {
    if (one.source == "left") continue;
    EXPECT_FALSE(one.estimate.rejection);
    const PoseError error = pose_error(one.estimate.T_target_source, rig.truth[one.source]);
    EXPECT_NEAR(error.dof(static_cast<Eigen::Index>(Dof::z)), 0.0, 0.003) << one.source;
  }
}

/// The standing rig with a time for each point: sensors scan one after another.
void add_times(StandingRig& rig) {
  const auto timed = [](const Cloud& cloud, double time_s) {
    PointCloud with = cloud.with_channels();
    with.channels.push_back(make_channel(kTime, std::vector<double>(with.points.size(), time_s)));
    return std::make_shared<const Cloud>(std::move(with), StreamKey(1));
  };
  double time_s = 1000.0;
  for (RigEstimate& one : rig.estimates) {
    one.estimate.target = timed(*one.estimate.target, 1000.0);
    one.estimate.source = timed(*one.estimate.source, time_s += 0.02);
  }
}

TEST(BundleAdjustment, WhatIsNotKnownOfTheVelocityMovesASensorByTheTimeBetweenScans) {
  StandingRig rig = standing_rig(1), known = rig;
  add_times(rig);
  Matrix6d motion = 1e-12 * Matrix6d::Identity();
  motion(3, 3) = 1.0;  // 1 m/s along x.
  for (RigEstimate& one : rig.estimates) one.estimate.extras.put(kMotionCovariance, motion);
  const std::string step =
      R"({"step": "bundle_adjustment", "prior_weight": 1, "prior_std": [10, 10]})";
  adjust_bundle(rig.estimates, step);
  adjust_bundle(known.estimates, step);
  // All points of a sensor are of one time, so that nothing but the covariance holds the velocity.
  double delay_s = 0.0;
  for (const RigEstimate& one : rig.estimates) {
    delay_s += 0.02;
    const Matrix6d more =
        one.estimate.covariance->matrix - of_sensor(known, one.source).estimate.covariance->matrix;
    EXPECT_NEAR(std::sqrt(more(3, 3)), delay_s, 0.1 * delay_s) << one.source;
    EXPECT_LT(more(4, 4), 0.01 * more(3, 3)) << one.source;
    EXPECT_LT(more(5, 5), 0.01 * more(3, 3)) << one.source;
  }
}

TEST(BundleAdjustment, AnErrorOfTheSpeedThatAllSurfacesShareMovesASensorAlongTheVelocity) {
  StandingRig rig = standing_rig(1);
  add_times(rig);
  const Twist velocity = {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.0, 8.0, 0.0)};
  for (RigEstimate& one : rig.estimates) {
    one.estimate.extras.put(kMotion, velocity);
    one.estimate.extras.put(kMotionCovariance, Matrix6d(1e-12 * Matrix6d::Identity()));
  }
  StandingRig without = rig;
  adjust_bundle(rig.estimates, R"({"step": "bundle_adjustment", "velocity_error_std_mps": 0.5})");
  adjust_bundle(without.estimates, R"({"step": "bundle_adjustment", "velocity_error_std_mps": 0})");
  double delay_s = 0.0;
  for (const RigEstimate& one : rig.estimates) {
    delay_s += 0.02;
    const Matrix6d more = one.estimate.covariance->matrix -
                          of_sensor(without, one.source).estimate.covariance->matrix;
    EXPECT_NEAR(std::sqrt(more(4, 4)), 0.5 * delay_s, 0.1 * delay_s) << one.source;
    EXPECT_LT(more(3, 3), 0.02 * more(4, 4)) << one.source;
    EXPECT_LT(more(5, 5), 0.02 * more(4, 4)) << one.source;
  }
}

/// Puts the rig into scenes of these velocities, whose clouds were corrected by them and by the
/// times of a sensor, which lack `offset_s`: it seems to stand back along the velocity.
void drive(StandingRig& rig, const std::string& sensor, double offset_s,
           const std::map<std::string, Twist>& velocities) {
  for (RigEstimate& one : rig.estimates) {
    const Twist& velocity = velocities.at(one.scene);
    one.estimate.extras.put(kMotion, velocity);
    if (one.source != sensor) continue;
    const RigidTransform& T = rig.truth[sensor];
    const RigidTransform back = T.inverse() * motion_over(velocity, -offset_s) * T;
    PointCloud cloud = one.estimate.source->with_channels();
    cloud.points = transformed(cloud.points, back);
    one.estimate.source = std::make_shared<const Cloud>(std::move(cloud), StreamKey(1));
  }
}

Twist velocity_of(double x_mps, double y_mps, double yaw_radps) {
  return {Eigen::Vector3d(0.0, 0.0, yaw_radps), Eigen::Vector3d(x_mps, y_mps, 0.0)};
}

TEST(BundleAdjustment, FindsTheOffsetOfAClockFromScenesOfDifferentVelocities) {
  constexpr double kOffset_s = 0.02;
  StandingRig rig = standing_rig(3);
  drive(rig, "left", kOffset_s,
        {{"0", velocity_of(0.0, 0.0, 0.0)},
         {"1", velocity_of(9.0, 0.0, 0.1)},
         {"2", velocity_of(4.0, 0.1, 0.0)}});
  StandingRig without = rig;
  adjust_bundle(rig.estimates, R"({"step": "bundle_adjustment", "clock_offset_std_s": 0.05})");
  adjust_bundle(without.estimates);
  for (const RigEstimate& one : rig.estimates) {
    ASSERT_EQ(one.failure, "");
    const double off_s =
        test::diagnostic(one.estimate, "clock_offset_s") - (one.source == "left" ? kOffset_s : 0.0);
    EXPECT_NEAR(off_s, 0.0, 0.001) << one.source;
    EXPECT_LT(std::abs(off_s), 5.0 * test::diagnostic(one.estimate, "clock_offset_std_s"))
        << one.source;
    const PoseError error = pose_error(one.estimate.T_target_source, rig.truth[one.source]);
    EXPECT_LT(error.translation_m, 0.005) << one.source;
  }
  const RigEstimate& left = of_sensor(without, "left");
  EXPECT_GT(pose_error(left.estimate.T_target_source, rig.truth["left"]).translation_m, 0.03);
}

TEST(BundleAdjustment, FindsTheOffsetOfAClockAndTheVelocities) {
  constexpr double kOffset_s = 0.02;
  StandingRig rig = standing_rig(2);
  add_times(rig);
  drive(rig, "left", kOffset_s,
        {{"0", velocity_of(0.0, 0.0, 0.0)}, {"1", velocity_of(9.0, 0.0, 0.0)}});
  Matrix6d motion = 1e-6 * Matrix6d::Identity();
  motion(3, 3) = 0.04;
  for (RigEstimate& one : rig.estimates) one.estimate.extras.put(kMotionCovariance, motion);
  adjust_bundle(rig.estimates, R"({"step": "bundle_adjustment", "clock_offset_std_s": 0.05})");
  const Estimate& left = of_sensor(rig, "left").estimate;
  // All points of a sensor are of one time, so a velocity and a pose that change together are free
  // but for what is known of them: the offset is known as well as those are.
  const double std_s = test::diagnostic(left, "clock_offset_std_s");
  EXPECT_LT(std_s, 0.01);
  EXPECT_LT(std::abs(test::diagnostic(left, "clock_offset_s") - kOffset_s), 3.0 * std_s);
}

/// Two clouds of points that are on no plane.
Estimate without_planes(Rng& rng) {
  Estimate estimate;
  estimate.target =
      std::make_shared<const Cloud>(test::random_cloud(rng, 2000, 10.0), StreamKey(1));
  estimate.source =
      std::make_shared<const Cloud>(test::random_cloud(rng, 2000, 10.0), StreamKey(2));
  return estimate;
}

TEST(BundleAdjustment, TooFewPlanesAreAnErrorWithItsReason) {
  Rng rng = test::test_rng();
  Estimate estimate = without_planes(rng);
  const auto step = test::stage<Step>(R"({"step": "bundle_adjustment"})");
  try {
    step->advance(estimate, rng);
    FAIL() << "no error";
  } catch (const StageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("shares only 0 planes with other sensors"));
  }
}

TEST(BundleAdjustment, TooFewPlanesLeaveAPoseThatIsKnown) {
  Rng rng = test::test_rng();
  Estimate estimate = without_planes(rng);
  estimate.T_target_source = test::random_pose(rng, 1.0);
  estimate.covariance = PoseCovariance{1e-4 * Matrix6d::Identity(), {}};
  const Estimate kept =
      test::stage<Step>(R"({"step": "bundle_adjustment"})")->advance(estimate, rng);
  EXPECT_EQ(kept.T_target_source.rotation, estimate.T_target_source.rotation);
  EXPECT_EQ(kept.T_target_source.translation, estimate.T_target_source.translation);
  EXPECT_LT((kept.covariance->matrix - estimate.covariance->matrix).norm(), 1e-12);
}

TEST(BundleAdjustment, APoseThatKeepsItsStartHasOneWordInAllScenes) {
  Rng rng = test::test_rng();
  std::vector<RigEstimate> rig;
  const RigidTransform pose = test::random_pose(rng, 1.0);
  for (const char* const scene : {"1", "2", "astray"}) {
    rig.push_back({scene, "top", "left", without_planes(rng)});
    Estimate& estimate = rig.back().estimate;
    estimate.T_target_source = pose;
    estimate.covariance = PoseCovariance{1e-4 * Matrix6d::Identity(), {}};
    estimate.covariance->dofs.fill(Observability::weak);
  }
  rig.front().estimate.covariance->dofs.front() = Observability::determined;
  rig[1].estimate.covariance->dofs.back() = Observability::determined;
  rig[2].estimate.covariance->dofs[2] = Observability::determined;
  rig[2].estimate.T_target_source.translation.x() += 0.6;
  adjust_bundle(rig);
  for (const RigEstimate& one : rig) {
    ASSERT_EQ(one.failure, "");
    const DofObservability& words = one.estimate.covariance->dofs;
    EXPECT_EQ(words.front(), Observability::determined) << one.scene;
    EXPECT_EQ(words.back(), Observability::determined) << one.scene;
    EXPECT_EQ(words[1], Observability::weak) << one.scene;
    EXPECT_EQ(words[2], Observability::weak) << one.scene;
  }
}

}  // namespace
}  // namespace croon
