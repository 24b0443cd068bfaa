#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/hypotheses.hpp"
#include "framework/stage/step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

Estimate estimate_of(const Points& target, const Points& source, const RigidTransform& T) {
  Estimate estimate;
  estimate.target = std::make_shared<const Cloud>(target, StreamKey(1).with("target"));
  estimate.source = std::make_shared<const Cloud>(source, StreamKey(1).with("source"));
  estimate.T_target_source = T;
  return estimate;
}

Estimate street_estimate(Rng& rng, std::uint64_t scene_seed) {
  const test::StreetPair pair =
      test::street_pair(rng, scene_seed, test::random_pose(rng, 0.5), 20000, 12000, 0.01);
  return estimate_of(pair.target, pair.source, pair.T_target_source);
}

params::Slot<Step> verdict() { return test::stage<Step>(R"({"step": "verdict"})"); }

TEST(Verdict, AcceptsTheTruth) {
  Rng rng = test::test_rng();
  for (std::uint64_t i = 0; i < 5; ++i) {
    const Estimate judged = verdict()->advance(street_estimate(rng, i), rng);
    EXPECT_FALSE(judged.rejection) << "street " << i << ": " << *judged.rejection;
  }
}

TEST(Verdict, HalvesOfTheOverlapAgreeBetterIfLittleOfTheCloudOverlaps) {
  Rng rng = test::test_rng(12);
  const auto split_overlap = test::stage<Step>(R"({"step": "verdict", "split_overlap": true})");
  const auto distance_m = [&](const params::Slot<Step>& step, const Estimate& estimate) {
    for (const auto& [name, value] : step->advance(estimate, rng).diagnostics) {
      if (name == "halves_translation_m") return value;
    }
    return -1.0;
  };
  double of_overlap_m = 0.0, of_all_m = 0.0;
  for (std::uint64_t i = 0; i < 5; ++i) {
    Estimate estimate = street_estimate(rng, i);
    Points source = estimate.source->points();
    // A block of another scene, out of sight of the target.
    for (const Eigen::Vector3f& point : test::random_cloud(rng, 60000, 20.0)) {
      source.push_back(point + Eigen::Vector3f(0.0F, 0.0F, 200.0F));
    }
    estimate.source = std::make_shared<const Cloud>(source, StreamKey(1).with("source"));
    of_overlap_m += distance_m(split_overlap, estimate);
    of_all_m += distance_m(verdict(), estimate);
  }
  EXPECT_GT(of_overlap_m, 0.0);
  EXPECT_LT(of_overlap_m, of_all_m);
}

TEST(Verdict, LeavesThePoseAsItIs) {
  Rng rng = test::test_rng(2);
  const Estimate before = street_estimate(rng, 3);
  const Estimate after = verdict()->advance(before, rng);
  EXPECT_EQ(after.T_target_source.rotation, before.T_target_source.rotation);
  EXPECT_EQ(after.T_target_source.translation, before.T_target_source.translation);
}

TEST(Verdict, RejectsPosesThatAreOff) {
  Rng rng = test::test_rng(3);
  const Estimate right = street_estimate(rng, 4);
  for (const auto& [dof, by] :
       {std::pair(Dof::yaw, rad_from_deg(90.0)), std::pair(Dof::yaw, rad_from_deg(180.0)),
        std::pair(Dof::roll, kPi), std::pair(Dof::pitch, 0.02), std::pair(Dof::x, 1.0),
        std::pair(Dof::x, 0.2), std::pair(Dof::y, -0.5), std::pair(Dof::z, 0.3)}) {
    Estimate off = right;
    Vector6d offset = Vector6d::Zero();
    offset(static_cast<Eigen::Index>(dof)) = by;
    off.T_target_source = moved(right.T_target_source, offset);
    EXPECT_TRUE(verdict()->advance(off, rng).rejection)
        << kDofNames[static_cast<std::size_t>(dof)] << " by " << by;
  }
}

TEST(Verdict, NamesTheDirectionsThatNothingHolds) {
  Rng rng = test::test_rng(4);
  const auto plain = [&] {
    Points points;
    for (int i = 0; i < 20000; ++i) {
      points.push_back(
          Eigen::Vector3d{rng.uniform(-15.0, 15.0), rng.uniform(-15.0, 15.0), -2.0}.cast<float>());
    }
    return points;
  };
  const Estimate judged = verdict()->advance(estimate_of(plain(), plain(), {}), rng);
  ASSERT_TRUE(judged.rejection);
  EXPECT_NE(judged.rejection->find("not constrained: x, y and yaw"), std::string::npos)
      << *judged.rejection;
}

TEST(Verdict, NamesTheAxisOfATunnel) {
  Rng rng = test::test_rng(5);
  const auto tunnel = [&] {
    Points points;
    for (int i = 0; i < 30000; ++i) {
      const auto along = static_cast<float>(rng.uniform(-30.0, 30.0));
      const auto across = static_cast<float>(rng.uniform(-4.0, 4.0));
      const auto up = static_cast<float>(rng.uniform(-2.0, 4.0));
      if (i % 3 == 0) points.emplace_back(along, across, -2.0F);
      if (i % 3 == 1) points.emplace_back(along, -4.0F, up);
      if (i % 3 == 2) points.emplace_back(along, 4.0F, up);
    }
    return points;
  };
  const Estimate judged = verdict()->advance(estimate_of(tunnel(), tunnel(), {}), rng);
  ASSERT_TRUE(judged.rejection);
  EXPECT_NE(judged.rejection->find("not constrained: x "), std::string::npos) << *judged.rejection;
}

/// The floor and the walls of a room that looks the same after half a turn about z.
Points bare_room(Rng& rng) {
  Points points;
  for (int i = 0; i < 30000; ++i) {
    const auto x = static_cast<float>(rng.uniform(-8.0, 8.0));
    const auto y = static_cast<float>(rng.uniform(-4.5, 4.5));
    const auto z = static_cast<float>(rng.uniform(-2.0, 3.0));
    if (i % 3 == 0) points.emplace_back(x, y, -2.0F);
    if (i % 3 == 1) points.emplace_back(x, i % 2 == 0 ? 4.5F : -4.5F, z);
    if (i % 3 == 2) points.emplace_back(i % 2 == 0 ? 8.0F : -8.0F, y, z);
  }
  return points;
}

TEST(Verdict, RejectsAPoseWithARivalThatFitsAsWell) {
  Rng rng = test::test_rng(6);
  const Points target = bare_room(rng);
  Estimate estimate = estimate_of(target, bare_room(rng), {});
  EXPECT_FALSE(verdict()->advance(estimate, rng).rejection);
  const RigidTransform turned = {rotation_exp(kPi * Eigen::Vector3d::UnitZ()), {0.0, 0.0, 0.0}};
  estimate.extras.put(kHypotheses, {{estimate.T_target_source, 1.0}, {turned, 1.0}});
  const auto rejection = verdict()->advance(estimate, rng).rejection;
  ASSERT_TRUE(rejection);
  EXPECT_NE(rejection->find("the lead over a pose turned by 180 degrees"), std::string::npos)
      << *rejection;
}

/// The ground and two walls along x with niches whose edges are at `edges_m`, ascending.
Points niches(Rng& rng, const std::vector<double>& edges_m) {
  Points points;
  const double length_m = edges_m.back() - edges_m.front();
  for (int i = 0; i < 40000; ++i) {
    const double x = edges_m.front() + length_m * rng.uniform();
    const double z = rng.uniform(-2.0, 3.0);
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const auto next = std::upper_bound(edges_m.begin(), edges_m.end() - 1, x);
    const bool is_deep = (next - edges_m.begin()) % 2 == 0;
    Eigen::Vector3d point{x, side * (is_deep ? 4.8 : 4.0), z};
    if (i % 4 == 0) point = {x, rng.uniform(-4.0, 4.0), -2.0};
    if (i % 4 == 1) point = {*next, side * rng.uniform(4.0, 4.8), z};
    points.push_back(point.cast<float>());
  }
  return points;
}

/// The verdict on the truth between two sensors at the same place.
Estimate judged_between(Rng& rng, const std::vector<double>& edges_m) {
  const Points target = niches(rng, edges_m);
  Estimate estimate = estimate_of(target, niches(rng, edges_m), {});
  estimate.extras.put(kHypotheses, {{estimate.T_target_source, 1.0}});
  return verdict()->advance(estimate, rng);
}

TEST(Verdict, NamesTheShiftAlongAPeriodicStreet) {
  Rng rng = test::test_rng(9);
  for (int street = 0; street < 5; ++street) {
    const double period_m = rng.uniform(2.0, 4.5);
    std::vector<double> edges_m;
    for (double x = -25.0; x < 25.0; x += 0.5 * period_m) edges_m.push_back(x);
    const auto rejection = judged_between(rng, edges_m).rejection;
    ASSERT_TRUE(rejection) << "period " << period_m;
    const std::string begins = "the lead over a pose ";
    const std::size_t at = rejection->find(begins);
    ASSERT_NE(at, std::string::npos) << *rejection;
    EXPECT_TRUE(rejection->find("m further along x,") != std::string::npos ||
                rejection->find("m further along -x,") != std::string::npos)
        << *rejection;
    const double shift_m = std::stod(rejection->substr(at + begins.size()));
    EXPECT_NEAR(std::remainder(shift_m, period_m), 0.0, 0.15) << *rejection;
  }
}

TEST(Verdict, FindsNoRivalIfNichesAreAtUnequalDistances) {
  Rng rng = test::test_rng(10);
  for (int street = 0; street < 5; ++street) {
    std::vector<double> edges_m;
    for (double x = -25.0; x < 25.0; x += rng.uniform(0.6, 4.0)) edges_m.push_back(x);
    const Estimate judged = judged_between(rng, edges_m);
    EXPECT_FALSE(judged.rejection) << *judged.rejection;
  }
}

TEST(Verdict, LeavesOutRivalsThatTheInitialGuessExcludes) {
  Rng rng = test::test_rng(11);
  std::vector<double> edges_m;
  for (double x = -25.0; x < 25.0; x += 1.5) edges_m.push_back(x);
  const Points target = niches(rng, edges_m);
  Estimate estimate = estimate_of(target, niches(rng, edges_m), {});
  estimate.extras.put(kHypotheses, {{estimate.T_target_source, 1.0}});
  for (const double bound_m : {1.0, 4.0}) {
    estimate.extras.put(kSearchRegion, {{}, {rad_from_deg(30.0), bound_m}});
    const auto rejection = verdict()->advance(estimate, rng).rejection;
    EXPECT_EQ(rejection.has_value(), bound_m > 3.0) << rejection.value_or("");
  }
}

TEST(Verdict, IsNotMisledByRivalsThatFitWorse) {
  Rng rng = test::test_rng(8);
  Estimate estimate = street_estimate(rng, 5);
  const RigidTransform T = estimate.T_target_source;
  Vector6d away = Vector6d::Zero();
  away(3) = 2.0;
  const RigidTransform turned = {rotation_exp(kPi * Eigen::Vector3d::UnitZ()) * T.rotation,
                                 T.translation};
  // What the search thought of them does not count.
  estimate.extras.put(kHypotheses, {{T, 1.0}, {moved(T, away), 1.9}, {turned, 1.9}});
  const Estimate judged = verdict()->advance(estimate, rng);
  EXPECT_FALSE(judged.rejection) << *judged.rejection;
}

TEST(Verdict, AddsItsReasonsToThoseOfStepsBefore) {
  Rng rng = test::test_rng(7);
  const Estimate right = street_estimate(rng, 6);
  // No overlap is enough for the first step.
  const Pipeline pipeline = {
      {"strict", test::stage<Step>(R"({"step": "verdict", "min_overlap_ratio": 1})")},
      {"default", verdict()}};
  const auto rejection_at = [&](const RigidTransform& T) {
    const PipelineResult result =
        run_pipeline(pipeline, right.target, right.source, T, StreamKey(5));
    return result.estimate.rejection.value_or("");
  };
  const std::string strict = "strict: the overlap with agreeing surfaces is ";
  const std::string accepted = rejection_at(right.T_target_source);
  EXPECT_EQ(accepted.rfind(strict, 0), 0U) << accepted;
  EXPECT_EQ(accepted.find("default"), std::string::npos) << accepted;
  Vector6d offset = Vector6d::Zero();
  offset(static_cast<Eigen::Index>(Dof::x)) = 1.0;
  const std::string rejected = rejection_at(moved(right.T_target_source, offset));
  EXPECT_EQ(rejected.rfind(strict, 0), 0U) << rejected;
  EXPECT_NE(rejected.find("; default: the "), std::string::npos) << rejected;
}

}  // namespace
}  // namespace croon
