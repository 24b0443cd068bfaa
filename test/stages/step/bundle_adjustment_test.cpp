#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/threads.hpp"
#include "framework/simulation/rig.hpp"
#include "framework/simulation/sensor_model.hpp"
#include "framework/simulation/simulated_scene.hpp"
#include "framework/stage/rig_step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;

/// All sensors of a standing car in its first scenes, with starts near the truth.
struct StandingRig {
  std::vector<RigEstimate> estimates;
  std::map<std::string, RigidTransform> truth;  ///< By sensor.
};

StandingRig standing_rig(std::uint64_t scenes) {
  StandingRig rig;
  Rng rng = test::test_rng();
  auto recipe = std::make_shared<simulation::Recipe>();
  recipe->rig = simulation::rigs().front().second;
  recipe->noise = simulation::real_still_noise();
  recipe->seed = 8201;
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

void adjust(std::vector<RigEstimate>& rig) {
  Rng rng = test::test_rng();
  const auto step = test::stage<Step>(R"({"step": "bundle_adjustment"})");
  dynamic_cast<const RigStep&>(*step).adjust(rig, rng);
}

TEST(BundleAdjustment, FindsOnePoseForEachSensorInAllScenes) {
  StandingRig rig = standing_rig(3);
  adjust(rig.estimates);
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
  }
}

TEST(BundleAdjustment, SaysHowWellEachPoseIsHeld) {
  StandingRig rig = standing_rig(2);
  adjust(rig.estimates);
  for (const RigEstimate& one : rig.estimates) {
    ASSERT_TRUE(one.estimate.covariance);
    const PoseCovariance& covariance = *one.estimate.covariance;
    EXPECT_TRUE(is_covariance(covariance.matrix));
    const PoseError error = pose_error(one.estimate.T_target_source, rig.truth[one.source]);
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

TEST(BundleAdjustment, ThreadsDoNotChangeABit) {
  std::vector<StandingRig> rigs;
  for (const int jobs : {1, 3}) {
    rigs.push_back(standing_rig(2));
    on_threads(jobs, [&] { adjust(rigs.back().estimates); });
  }
  for (std::size_t i = 0; i < rigs[0].estimates.size(); ++i) {
    const RigidTransform& one = rigs[0].estimates[i].estimate.T_target_source;
    const RigidTransform& other = rigs[1].estimates[i].estimate.T_target_source;
    EXPECT_EQ(one.rotation, other.rotation);
    EXPECT_EQ(one.translation, other.translation);
  }
}

TEST(BundleAdjustment, ASensorIsHeldByOthersThanTheReference) {
  StandingRig rig = standing_rig(1);
  // The reference keeps what is more than 15 m away; the others see 20 m far.
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
  adjust(rig.estimates);
  adjust(alone);
  const auto error_m = [&](const RigEstimate& one) {
    return pose_error(one.estimate.T_target_source, rig.truth["back"]).translation_m;
  };
  for (const RigEstimate& one : rig.estimates) {
    if (one.source != "back") continue;
    EXPECT_LT(error_m(one), 0.02);
    if (!alone.front().failure.empty()) continue;
    EXPECT_LT(error_m(one), error_m(alone.front()));
  }
}

TEST(BundleAdjustment, TooFewPlanesAreAnErrorWithItsReason) {
  Rng rng = test::test_rng();
  Estimate estimate;
  estimate.target =
      std::make_shared<const Cloud>(test::random_cloud(rng, 2000, 10.0), StreamKey(1));
  estimate.source =
      std::make_shared<const Cloud>(test::random_cloud(rng, 2000, 10.0), StreamKey(2));
  const auto step = test::stage<Step>(R"({"step": "bundle_adjustment"})");
  try {
    step->advance(estimate, rng);
    FAIL() << "no error";
  } catch (const StageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("shared with another sensor"));
  }
}

}  // namespace
}  // namespace croon
