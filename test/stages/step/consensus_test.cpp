#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/geometry/dof.hpp"
#include "framework/stage/rig_step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

/// The estimates of `sensor` in as many scenes, within 0.1 deg and 1 cm per axis of `truth`.
std::vector<RigEstimate> near_estimates(Rng& rng, const std::string& sensor,
                                        const RigidTransform& truth, int scenes) {
  std::vector<RigEstimate> rig;
  for (int i = 0; i < scenes; ++i) {
    rig.push_back({std::to_string(i), "top", sensor, {}});
    rig.back().estimate.T_target_source = test::pose_near(rng, truth, 0.1, 0.01);
  }
  return rig;
}

/// Adjusts the rig; in `failed` more scenes a step before has failed.
void adjust(std::vector<RigEstimate>& rig, const std::string& parameters = "",
            std::size_t failed = 0) {
  Rng rng = test::test_rng();
  for (RigEstimate& one : rig) {
    const auto is_of_sensor = [&](const RigEstimate& other) {
      return other.target == one.target && other.source == one.source;
    };
    one.scenes =
        static_cast<std::size_t>(std::count_if(rig.begin(), rig.end(), is_of_sensor)) + failed;
  }
  const auto step = test::stage<Step>(R"({"step": "consensus")" + parameters + "}");
  dynamic_cast<const RigStep&>(*step).adjust(rig, rng);
}

double distance(const RigidTransform& a, const RigidTransform& b) {
  const PoseError error = pose_error(a, b);
  return error.rotation_rad + error.translation_m;
}

TEST(Consensus, GivesEachSensorOnePoseNearTheTruth) {
  Rng rng = test::test_rng();
  const RigidTransform left = test::random_pose(rng, 3.0), right = test::random_pose(rng, 3.0);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", left, 5);
  for (RigEstimate& one : near_estimates(rng, "right", right, 5)) rig.push_back(one);
  adjust(rig);
  for (const RigEstimate& one : rig) {
    const RigEstimate& first = one.source == "left" ? rig.front() : rig.back();
    EXPECT_EQ(one.estimate.T_target_source.rotation, first.estimate.T_target_source.rotation);
    EXPECT_EQ(one.estimate.T_target_source.translation, first.estimate.T_target_source.translation);
    EXPECT_LT(distance(one.estimate.T_target_source, one.source == "left" ? left : right), 0.02);
    EXPECT_FALSE(one.estimate.rejection);
  }
}

TEST(Consensus, DoesNotDependOnTheOrderOfScenes) {
  Rng rng = test::test_rng(2);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", test::random_pose(rng, 3.0), 7);
  std::vector<RigEstimate> reversed = rig;
  std::reverse(reversed.begin(), reversed.end());
  adjust(rig);
  adjust(reversed);
  EXPECT_EQ(rig[0].estimate.T_target_source.rotation,
            reversed[0].estimate.T_target_source.rotation);
  EXPECT_EQ(rig[0].estimate.T_target_source.translation,
            reversed[0].estimate.T_target_source.translation);
}

TEST(Consensus, IsNotMovedByAWrongScene) {
  Rng rng = test::test_rng(3);
  const RigidTransform truth = test::random_pose(rng, 3.0);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", truth, 4);
  std::vector<RigEstimate> with_wrong = rig;
  with_wrong.push_back(rig.front());
  with_wrong.back().estimate.T_target_source = test::random_pose(rng, 3.0);
  adjust(rig);
  adjust(with_wrong);
  for (const RigEstimate& one : with_wrong) {
    EXPECT_LT(distance(one.estimate.T_target_source, rig[0].estimate.T_target_source), 1e-12);
    EXPECT_EQ(one.estimate.diagnostics[1].second, 0.8);
    EXPECT_FALSE(one.estimate.rejection);
  }
}

TEST(Consensus, RejectsWhereScenesDoNotAgree) {
  Rng rng = test::test_rng(4);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", test::random_pose(rng, 3.0), 2);
  rig.back().estimate.T_target_source = test::random_pose(rng, 3.0);
  std::vector<RigEstimate> lenient = rig;
  adjust(rig);
  for (const RigEstimate& one : rig) {
    EXPECT_EQ(one.estimate.rejection, "the poses of 1 of 2 scenes agree, a share below 0.60");
  }
  adjust(lenient, R"(, "min_agreeing_ratio": 0.5)");
  EXPECT_FALSE(lenient.front().estimate.rejection);
}

TEST(Consensus, AFailedSceneDoesNotAgree) {
  Rng rng = test::test_rng(9);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", test::random_pose(rng, 3.0), 2);
  adjust(rig, "", 3);
  EXPECT_EQ(rig.front().estimate.rejection, "the poses of 2 of 5 scenes agree, a share below 0.60");
}

TEST(Consensus, RejectedPosesHaveNoVoteBesideAcceptedOnes) {
  Rng rng = test::test_rng(5);
  const RigidTransform truth = test::random_pose(rng, 3.0);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", truth, 5);
  const RigidTransform wrong = test::random_pose(rng, 3.0);
  for (std::size_t i : {0U, 1U}) {
    rig[i].estimate.T_target_source = wrong;
    rig[i].estimate.rejection = "verdict: no overlap";
  }
  adjust(rig);
  for (const RigEstimate& one : rig) {
    EXPECT_LT(distance(one.estimate.T_target_source, truth), 0.02);
    EXPECT_FALSE(one.estimate.rejection);
  }
  for (RigEstimate& one : rig) one.estimate.rejection = "verdict: no overlap";
  adjust(rig);
  for (const RigEstimate& one : rig) EXPECT_EQ(one.estimate.rejection, "verdict: no overlap");
}

TEST(Consensus, IsTheMeanOfExactlyThePosesThatAgree) {
  Rng rng = test::test_rng(6);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<RigEstimate> rig = near_estimates(rng, "left", {}, 7);
    std::vector<double> x_m;
    for (RigEstimate& one : rig) {
      x_m.push_back(rng.uniform(-0.15, 0.15));
      one.estimate.T_target_source = {};
      one.estimate.T_target_source.translation.x() = x_m.back();
    }
    adjust(rig);
    const Estimate& found = rig.front().estimate;
    const auto agreeing = std::llround(7.0 * test::diagnostic(found, "agreeing_ratio"));
    // Along a line they are neighbours.
    std::sort(x_m.begin(), x_m.end());
    double nearest_m = 1.0;
    for (auto first = x_m.begin(); x_m.end() - first >= agreeing; ++first) {
      const double mean_m = std::accumulate(first, first + agreeing, 0.0) / agreeing;
      nearest_m = std::min(nearest_m, std::abs(mean_m - found.T_target_source.translation.x()));
    }
    EXPECT_LT(nearest_m, 1e-12) << trial;
  }
}

TEST(Consensus, ByCovarianceFollowsTheScenesThatKnowBest) {
  Rng rng = test::test_rng();
  const RigidTransform truth = test::random_pose(rng, 3.0);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", truth, 5);
  for (std::size_t i = 0; i < rig.size(); ++i) {
    const double std = i == 3 ? 1e-5 : 1e-2;
    rig[i].estimate.covariance = PoseCovariance{std * std * Matrix6d::Identity(), {}};
  }
  const RigidTransform best = rig[3].estimate.T_target_source;
  adjust(rig, R"(, "weights": "covariance")");
  for (const RigEstimate& one : rig) {
    EXPECT_LT(distance(one.estimate.T_target_source, best), 1e-6);
    EXPECT_NEAR(std::sqrt(one.estimate.covariance->matrix(0, 0)), 1e-5, 1e-7);
  }
  std::vector<RigEstimate> unknown = near_estimates(rng, "left", truth, 2);
  adjust(unknown, R"(, "weights": "covariance")");
  for (const RigEstimate& one : unknown) EXPECT_NE(one.failure, "");
}

TEST(Consensus, LeavesOneSceneAsItIs) {
  Rng rng = test::test_rng(6);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", test::random_pose(rng, 3.0), 1);
  const RigidTransform before = rig.front().estimate.T_target_source;
  adjust(rig);
  EXPECT_EQ(rig.front().estimate.T_target_source.rotation, before.rotation);
  EXPECT_EQ(rig.front().estimate.T_target_source.translation, before.translation);
}

TEST(Consensus, AddsTheInformationOfScenesThatAgree) {
  Rng rng = test::test_rng(7);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", test::random_pose(rng, 3.0), 4);
  for (RigEstimate& one : rig) one.estimate.information = Matrix6d::Identity();
  rig.back().estimate.T_target_source = test::random_pose(rng, 3.0);
  std::vector<RigEstimate> without = rig;
  adjust(rig);
  ASSERT_TRUE(rig.front().estimate.information);
  EXPECT_EQ((*rig.front().estimate.information)(2, 2), 3.0);
  without.front().estimate.information.reset();
  adjust(without);
  EXPECT_FALSE(without.back().estimate.information);
}

TEST(Consensus, KeepsPairsOfOneSensorApart) {
  Rng rng = test::test_rng(8);
  const RigidTransform to_top = test::random_pose(rng, 3.0), to_left = test::random_pose(rng, 3.0);
  std::vector<RigEstimate> rig = near_estimates(rng, "right", to_top, 3);
  for (RigEstimate& one : near_estimates(rng, "right", to_left, 3)) {
    one.target = "left";
    rig.push_back(one);
  }
  adjust(rig);
  EXPECT_LT(distance(rig.front().estimate.T_target_source, to_top), 0.02);
  EXPECT_LT(distance(rig.back().estimate.T_target_source, to_left), 0.02);
}

TEST(Consensus, HasTheCovarianceOfAMeanOfScenes) {
  Rng rng = test::test_rng(12);
  const PoseCovariance covariance = test::random_covariance(rng);
  const RigidTransform truth = test::random_pose(rng, 3.0);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", truth, 4);
  for (RigEstimate& one : rig) one.estimate.covariance = covariance;
  rig.push_back({"astray", "top", "left", {}});
  rig.back().estimate.T_target_source = test::random_pose(rng, 9.0);
  auto without = rig;
  adjust(rig);
  for (const RigEstimate& one : rig) {
    ASSERT_TRUE(one.estimate.covariance);  // Also where the pose was another.
    EXPECT_LT((4.0 * one.estimate.covariance->matrix - covariance.matrix).norm(), 1e-9);
    EXPECT_EQ(one.estimate.covariance->dofs, covariance.dofs);
  }
  without.front().estimate.covariance.reset();
  adjust(without);
  EXPECT_FALSE(without.back().estimate.covariance);
}

TEST(Consensus, ASceneWithoutWeightInADirectionDoesNotMakeItUnobservable) {
  Rng rng = test::test_rng(14);
  const RigidTransform truth = test::random_pose(rng, 3.0);
  std::vector<RigEstimate> rig = near_estimates(rng, "left", truth, 4);
  for (RigEstimate& one : rig) {
    one.estimate.covariance = PoseCovariance();
    one.estimate.covariance->matrix = 1e-6 * Matrix6d::Identity();
  }
  // A corridor along x.
  rig.back().estimate.covariance->matrix(3, 3) = kUnknown_m * kUnknown_m;
  rig.back().estimate.covariance->dofs[3] = Observability::unobservable;
  auto alike = rig;
  adjust(rig, R"(, "weights": "covariance")");
  adjust(alike);
  EXPECT_EQ(rig.front().estimate.covariance->dofs[3], Observability::determined);
  EXPECT_LT(rig.front().estimate.covariance->matrix(3, 3), 1e-6);
  EXPECT_EQ(alike.front().estimate.covariance->dofs[3], Observability::unobservable);
}

}  // namespace
}  // namespace croon
