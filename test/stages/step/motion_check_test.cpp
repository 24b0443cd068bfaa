#include <gtest/gtest.h>

#include "framework/simulation/rig.hpp"
#include "framework/simulation/sensor_model.hpp"
#include "framework/simulation/simulated_scene.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/rig_step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

std::shared_ptr<const simulation::Recipe> checked_recipe(const simulation::Noise& noise) {
  auto made = std::make_shared<simulation::Recipe>();
  made->rig = simulation::rigs().front().second;
  made->noise = noise;
  made->seed = 8101;
  return made;
}

/// The index of the first scene of the recipe that is faster than 6 m/s if its cars drive.
std::uint64_t fast_scene() {
  for (std::uint64_t index = 0;; ++index) {
    const simulation::SimulatedScene scene(checked_recipe(simulation::real_noise()), index);
    if (scene.world().car.motion.speed_mps > 6.0) return index;
  }
}

/// Two sensors of a scene at their true poses; the clouds have no times.
std::vector<RigEstimate> rig_of(const simulation::Noise& noise) {
  const auto made = checked_recipe(noise);
  const simulation::SimulatedScene scene(made, fast_scene());
  const auto thin =
      test::stage<Preprocessor>(R"({"type": "voxel_downsample", "leaf_size_m": 0.2})");
  const auto scan = [&](const std::string& sensor) {
    PointCloud cloud = scene.scan_of(sensor);
    cloud.channels.clear();
    return std::make_shared<const Cloud>(thin->apply(cloud), StreamKey(1));
  };
  const auto target = scan("top");
  std::vector<RigEstimate> rig;
  for (const auto& [sensor, mounting] : made->rig.sensors) {
    if (sensor != "back" && sensor != "left") continue;
    rig.push_back({"0", "top", sensor, {}});
    rig.back().estimate.target = target;
    rig.back().estimate.source = scan(sensor);
    rig.back().estimate.T_target_source = mounting.T_reference_sensor();
  }
  return rig;
}

void check(std::vector<RigEstimate>& rig) {
  Rng rng = test::test_rng();
  const auto step = test::stage<Step>(R"({"step": "motion_check"})");
  dynamic_cast<const RigStep&>(*step).adjust(rig, rng);
}

TEST(MotionCheck, RejectsThePosesOfACarThatDrove) {
  std::vector<RigEstimate> rig = rig_of(simulation::real_noise());
  check(rig);
  for (const RigEstimate& one : rig) {
    EXPECT_EQ(one.failure, "");
    ASSERT_TRUE(one.estimate.rejection) << one.source;
    EXPECT_NE(one.estimate.rejection->find("motion during the scans explains the clouds better"),
              std::string::npos);
    EXPECT_GT(test::diagnostic(one.estimate, "travel_m"), 0.4);
  }
}

TEST(MotionCheck, AcceptsACarAtRestAndLeavesItsPosesAlone) {
  std::vector<RigEstimate> rig = rig_of(simulation::real_still_noise());
  const RigidTransform before = rig.front().estimate.T_target_source;
  check(rig);
  for (const RigEstimate& one : rig) {
    EXPECT_EQ(one.failure, "");
    EXPECT_FALSE(one.estimate.rejection) << *one.estimate.rejection;
    EXPECT_LT(test::diagnostic(one.estimate, "travel_m"), 0.05);
  }
  EXPECT_EQ(rig.front().estimate.T_target_source.translation, before.translation);
}

TEST(MotionCheck, LeavesScenesAloneWhoseMotionIsKnown) {
  std::vector<RigEstimate> rig = rig_of(simulation::real_noise());
  for (RigEstimate& one : rig) one.estimate.extras.put(kMotion, Twist());
  check(rig);
  for (const RigEstimate& one : rig) EXPECT_FALSE(one.estimate.rejection);
}

TEST(MotionCheck, KeepsEarlierReasonsAndSkipsScenesWithoutAnAcceptedPose) {
  std::vector<RigEstimate> rig = rig_of(simulation::real_noise());
  rig.front().estimate.rejection = "an earlier reason";
  check(rig);
  EXPECT_EQ(rig.front().estimate.rejection->rfind("an earlier reason; motion", 0), 0U);
  for (RigEstimate& one : rig) one.estimate.rejection = "an earlier reason";
  check(rig);
  for (const RigEstimate& one : rig) EXPECT_EQ(*one.estimate.rejection, "an earlier reason");
}

}  // namespace
}  // namespace croon
