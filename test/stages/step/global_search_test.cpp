#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/stage/hypotheses.hpp"
#include "framework/stage/step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

Estimate estimate_of(const test::StreetPair& pair) {
  Estimate estimate;
  estimate.target = std::make_shared<const Cloud>(pair.target, StreamKey(1).with("target"));
  estimate.source = std::make_shared<const Cloud>(pair.source, StreamKey(1).with("source"));
  return estimate;
}

/// The steps that need no start.
class GlobalSearch : public testing::TestWithParam<std::string> {
 protected:
  static params::Slot<Step> step_of(const std::string& more = "") {
    return test::stage<Step>("{\"step\": \"" + GetParam() + "\"" + more + "}");
  }
};

/// A street seen by two sensors, the second turned by any rotation.
test::StreetPair random_pair(Rng& rng, std::uint64_t scene_seed) {
  RigidTransform T_target_source = test::random_pose(rng, 1.0);
  // Both sensors are above the road.
  T_target_source.translation.z() *= 0.5;
  return test::street_pair(rng, scene_seed, T_target_source, 20000, 12000, 0.01);
}

TEST_P(GlobalSearch, FindsThePoseOfASensorThatIsTurnedAnyhow) {
  Rng rng = test::test_rng();
  const auto step = step_of();
  for (std::uint64_t i = 0; i < 3; ++i) {
    const test::StreetPair pair = random_pair(rng, i);
    const Estimate found = step->advance(estimate_of(pair), rng);
    const PoseError error = pose_error(found.T_target_source, pair.T_target_source);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.5) << "street " << i;
    EXPECT_LT(error.translation_m, 0.1) << "street " << i;
  }
}

TEST_P(GlobalSearch, FindsThePoseUnderAReferenceThatIsUpsideDown) {
  Rng rng = test::test_rng(2);
  const auto step = step_of();
  for (std::uint64_t i = 0; i < 2; ++i) {
    const RigidTransform T_target_source = test::random_pose(rng, 0.5);
    RigidTransform T_target_street;
    T_target_street.rotation = rotation_from_rpy({kPi, 0.2, 0.4});
    const test::StreetPair pair =
        test::street_pair(rng, 20 + i, T_target_source, 20000, 12000, 0.01, T_target_street);
    const Estimate found = step->advance(estimate_of(pair), rng);
    const PoseError error = pose_error(found.T_target_source, pair.T_target_source);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.5) << "street " << i;
    EXPECT_LT(error.translation_m, 0.1) << "street " << i;
  }
}

TEST_P(GlobalSearch, DoesNotDependOnTheStart) {
  Rng rng = test::test_rng(3);
  const auto step = step_of();
  Estimate estimate = estimate_of(random_pair(rng, 5));
  const RigidTransform first = step->advance(estimate, rng).T_target_source;
  estimate.T_target_source = test::random_pose(rng, 100.0);
  Rng other = test::test_rng(10);
  const RigidTransform again = step->advance(estimate, other).T_target_source;
  EXPECT_EQ(again.rotation, first.rotation);
  EXPECT_EQ(again.translation, first.translation);
}

TEST_P(GlobalSearch, KeepsToTheStartIfAsked) {
  Rng rng = test::test_rng(4);
  const auto step =
      step_of(R"(, "use_start": true, "max_rotation_deg": 10, "max_translation_m": 0.5)");
  const test::StreetPair pair = random_pair(rng, 6);
  Estimate estimate = estimate_of(pair);
  estimate.T_target_source = test::pose_near(rng, pair.T_target_source, 3.0, 0.2);
  const PoseError error =
      pose_error(step->advance(estimate, rng).T_target_source, pair.T_target_source);
  EXPECT_LT(deg_from_rad(error.rotation_rad), 0.5);
  estimate.T_target_source.translation += Eigen::Vector3d(200.0, 0.0, 0.0);
  EXPECT_THROW(step->advance(estimate, rng), StageError);
}

TEST_P(GlobalSearch, GivesHypothesesApartFromEachOtherBestFirst) {
  Rng rng = test::test_rng(5);
  const auto step = step_of();
  const Estimate found = step->advance(estimate_of(random_pair(rng, 7)), rng);
  const std::vector<Hypothesis>& poses = found.extras.get(kHypotheses);
  ASSERT_FALSE(poses.empty());
  EXPECT_EQ(poses.front().T_target_source.translation, found.T_target_source.translation);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_LE(poses[i].score, poses[i - 1].score);
    const PoseError apart = pose_error(poses[i].T_target_source, poses[0].T_target_source);
    EXPECT_TRUE(apart.translation_m > 0.3 || deg_from_rad(apart.rotation_rad) > 1.0);
  }
}

TEST_P(GlobalSearch, RefusesAnEmptyCloud) {
  Rng rng = test::test_rng(6);
  const auto step = step_of();
  test::StreetPair pair = random_pair(rng, 8);
  pair.source.clear();
  EXPECT_THROW(step->advance(estimate_of(pair), rng), StageError);
}

INSTANTIATE_TEST_SUITE_P(Steps, GlobalSearch,
                         testing::Values("feature_alignment", "global_alignment"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace croon
