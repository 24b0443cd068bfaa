// Every step that sees a whole rig, on two scenes with two sensors: whole, and with one missing.
#include <algorithm>

#include "framework/base/threads.hpp"
#include "framework/stage/rig_step.hpp"
#include "test/contract/every_stage.hpp"
#include "test/contract/outcome.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon::test {
namespace {

std::vector<StageCase> every_rig_step() {
  std::vector<StageCase> steps = every_stage_of(Step::kKind);
  const auto sees_pairs = [](const StageEntry& entry) {
    const auto step = stage<Step>(minimal_json(entry));
    return dynamic_cast<const RigStep*>(&*step) == nullptr;
  };
  steps.erase(std::remove_if(steps.begin(), steps.end(), sees_pairs), steps.end());
  return steps;
}

/// The sensors "left" and "right" in the scenes "a" and "b", near their true poses. Nothing has
/// been computed yet of their clouds.
Rig street_rig() {
  const RigidTransform T_top_left = {rotation_from_rpy({0.05, -0.1, 0.6}), {0.2, 0.8, -0.3}};
  const RigidTransform T_top_right = {rotation_from_rpy({-0.1, 0.05, -0.6}), {0.2, -0.8, -0.3}};
  Rng rng = test_rng(12);
  Rig rig;
  for (const std::string scene : {"a", "b"}) {
    const std::uint64_t scene_seed = scene == "a" ? 4 : 5;
    const Points target = random_street(rng, scene_seed, 8000, 0.01);
    std::shared_ptr<const Cloud> shared_target;
    for (const std::string sensor : {"left", "right"}) {
      const RigidTransform& T_top_sensor = sensor == "left" ? T_top_left : T_top_right;
      const Points source = random_street(rng, scene_seed, 5000, 0.01);
      const CloudPair clouds = cloud_pair(target, transformed(source, T_top_sensor.inverse()));
      if (!shared_target) shared_target = clouds.target;
      rig.push_back(
          {scene, "top", sensor, StreamKey(6).with(scene).with(sensor),
           at_start(shared_target, clouds.source, pose_near(rng, T_top_sensor, 1.0, 0.05))});
    }
  }
  return rig;
}

class ContractOfRigs : public EveryStage {
 protected:
  /// With TBB on `jobs` threads.
  Outcome outcome_on(int jobs, const Rig& rig) const {
    Outcome outcome;
    on_threads(jobs, [&] { outcome = outcome_of_rig(minimal_json(entry()), rig); });
    return outcome;
  }
};

TEST_P(ContractOfRigs, SameOnOneThreadAndOnFour) {
  const Outcome alone = outcome_on(1, street_rig());
  EXPECT_EQ(alone.stage_error, "");
  EXPECT_FALSE(alone.numbers.empty());
  EXPECT_TRUE(alone.is_finite());
  EXPECT_EQ(outcome_on(4, street_rig()).bits(), alone.bits());
}

TEST_P(ContractOfRigs, NeedNotHaveEverySensorInEachScene) {
  Rig rig = street_rig();
  rig.pop_back();
  const Outcome outcome = outcome_on(4, rig);
  EXPECT_EQ(outcome.stage_error, "");
  EXPECT_FALSE(outcome.numbers.empty());
  EXPECT_TRUE(outcome.is_finite());
}

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfRigs, testing::ValuesIn(every_rig_step()),
                         stage_case_name);

}  // namespace
}  // namespace croon::test
