#include "framework/registration/pose_evidence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/registration/constraint.hpp"
#include "framework/registration/direction_balance.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

SensorView view_of(const Points& points, std::uint64_t seed, int cells = 90) {
  SensorView view{
      std::make_shared<const Cloud>(points, StreamKey(seed)), RangeImage(points, cells), 10, {}};
  view.sample = balanced_sample(*view.thinned, view.normal_neighbours, 1500);
  return view;
}

TEST(PoseEvidence, IsBestAtTheTruth) {
  Rng rng = test::test_rng();
  for (std::uint64_t i = 0; i < 5; ++i) {
    const test::StreetPair pair =
        test::street_pair(rng, i, test::random_pose(rng, 1.0), 20000, 12000, 0.01);
    const SensorView target = view_of(pair.target, 1);
    const SensorView source = view_of(pair.source, 2);
    const PoseEvidence truth = pose_evidence(target, source, pair.T_target_source);
    EXPECT_GT(truth.overlap_ratio(), 0.4) << "street " << i;
    for (int k = 0; k < 10; ++k) {
      const RigidTransform off = test::pose_near(rng, pair.T_target_source, 20.0, 2.0);
      EXPECT_LT(pose_evidence(target, source, off).score(), truth.score()) << "street " << i;
    }
  }
}

TEST(PoseEvidence, KnowsPointsInFreeSpace) {
  Rng rng = test::test_rng(2);
  Points wall;
  Points board;
  for (int i = 0; i < 20000; ++i) {
    const auto y = static_cast<float>(rng.uniform(-6.0, 6.0));
    const auto z = static_cast<float>(rng.uniform(-6.0, 6.0));
    wall.emplace_back(10.0F, y, z);
    if (i < 2000) board.emplace_back(5.0F, 0.2F * y, 0.2F * z);
  }
  const PoseEvidence evidence = pose_evidence(view_of(wall, 1), view_of(board, 2), {});
  const auto count = [](const std::vector<Sight>& sights, Sight sight) {
    return std::count(sights.begin(), sights.end(), sight);
  };
  EXPECT_GT(10 * count(evidence.source, Sight::violates),
            9 * static_cast<int>(evidence.source.size()));
  EXPECT_GT(count(evidence.target, Sight::hidden), 0);
  EXPECT_GT(evidence.violation_ratio(), 0.9);
  EXPECT_EQ(evidence.overlap_ratio(), 0.0);
}

TEST(PoseEvidence, HasEachPointOfTheSamplesOnce) {
  Rng rng = test::test_rng(3);
  const test::StreetPair pair =
      test::street_pair(rng, 3, test::random_pose(rng, 1.0), 8000, 5000, 0.01);
  const SensorView target = view_of(pair.target, 1);
  const SensorView source = view_of(pair.source, 2);
  const PoseEvidence evidence = pose_evidence(target, source, test::random_pose(rng, 3.0));
  EXPECT_EQ(evidence.source.size(), source.sample.size());
  EXPECT_EQ(evidence.target.size(), target.sample.size());
}

/// Evidence of so many points that agree, disagree and are unseen, in this order.
PoseEvidence evidence_of(int agree, int disagree, int unseen) {
  PoseEvidence evidence;
  evidence.source.insert(evidence.source.end(), agree, Sight::agrees);
  evidence.source.insert(evidence.source.end(), disagree, Sight::disagrees);
  evidence.source.insert(evidence.source.end(), unseen, Sight::unseen);
  return evidence;
}

TEST(PoseEvidence, LeadsByWhatAgreesAtOnePoseAlone) {
  const PoseEvidence more = evidence_of(90, 10, 0);
  const PoseEvidence fewer = evidence_of(65, 35, 0);
  EXPECT_DOUBLE_EQ(lead_over(more, fewer).value(), 5.0);
  EXPECT_DOUBLE_EQ(lead_over(fewer, more).value(), -5.0);
  EXPECT_EQ(lead_over(more, more).value(), 0.0);
  // What is unseen at one of the poses does not count, and 40 % must be seen at both.
  EXPECT_DOUBLE_EQ(lead_over(more, evidence_of(50, 16, 34)).value(), 4.0);
  EXPECT_TRUE(lead_over(more, evidence_of(40, 0, 60)));
  EXPECT_FALSE(lead_over(more, evidence_of(39, 0, 61)));
  EXPECT_FALSE(lead_over(evidence_of(0, 0, 100), more));
}

TEST(PoseEvidence, LeadsByFreeSpaceToo) {
  const PoseEvidence free = evidence_of(50, 25, 0);
  PoseEvidence violated = free;
  std::fill_n(violated.source.begin() + 50, 25, Sight::violates);
  EXPECT_DOUBLE_EQ(lead_over(free, violated).value(), 5.0);
  EXPECT_DOUBLE_EQ(lead_over(violated, free).value(), -5.0);
}

/// The floor and the walls of a room that looks the same after half a turn about z, as a sensor at
/// `origin` sees them, with noise.
Points room_from(Rng& rng, const Eigen::Vector3d& origin, int count) {
  Points points;
  while (static_cast<int>(points.size()) < count) {
    Eigen::Vector3d ray;
    for (double& part : ray) part = rng.normal();
    ray.normalize();
    double range_m = ray.z() < 0.0 ? (-2.0 - origin.z()) / ray.z() : 100.0;
    for (const int axis : {0, 1}) {
      const double wall_m = std::copysign(axis == 0 ? 8.0 : 4.5, ray(axis));
      range_m = std::min(range_m, (wall_m - origin(axis)) / ray(axis));
    }
    range_m += 0.02 * rng.normal();
    if (origin.z() + range_m * ray.z() < 3.0) points.push_back((range_m * ray).cast<float>());
  }
  return points;
}

TEST(PoseEvidence, HasNoLeadWhereHalfATurnLooksTheSame) {
  Rng rng = test::test_rng(3);
  double square_sum = 0.0;
  constexpr int kRooms = 10;
  for (int i = 0; i < kRooms; ++i) {
    const Eigen::Vector3d at = rng.uniform(0.5, 2.0) * Eigen::Vector3d::UnitX();
    const SensorView target = view_of(room_from(rng, Eigen::Vector3d::Zero(), 20000), 1, 30);
    const SensorView source = view_of(room_from(rng, at, 20000), 2, 30);
    const RigidTransform turned = {rotation_exp(kPi * Eigen::Vector3d::UnitZ()), -at};
    const RigidTransform off = {Eigen::Matrix3d::Identity(), at + Eigen::Vector3d(0.3, 0.3, 0.0)};
    const PoseEvidence right = pose_evidence(target, source, {Eigen::Matrix3d::Identity(), at});
    const double lead = lead_over(right, pose_evidence(target, source, turned)).value();
    EXPECT_LT(std::abs(lead), 4.0) << "room " << i;
    square_sum += lead * lead;
    EXPECT_GT(lead_over(right, pose_evidence(target, source, off)).value(), 10.0) << i;
  }
  // Points side by side err together, so it is a little more than one.
  EXPECT_LT(std::sqrt(square_sum / kRooms), 2.0);
}

TEST(BalancedSample, KeepsSurfacesOfRareDirections) {
  Rng rng = test::test_rng(4);
  Points points;
  for (int i = 0; i < 20000; ++i) {
    const auto x = static_cast<float>(rng.uniform(-15.0, 15.0));
    const auto y = static_cast<float>(rng.uniform(-15.0, 15.0));
    if (i % 100 == 0) {
      points.emplace_back(20.0F, 0.05F * y, 0.05F * x);
    } else {
      points.emplace_back(x, y, -2.0F);
    }
  }
  const Cloud cloud(points, StreamKey(1));
  const std::vector<int> sample = balanced_sample(cloud, 10, 1000);
  EXPECT_LE(sample.size(), 1001U);
  EXPECT_GT(sample.size(), 900U);
  int rare = 0;
  for (const int i : sample) rare += points[i].x() > 19.0F ? 1 : 0;
  // 1 % of the points; by the square root of 200 and 19800 points, 9 % of the sample.
  EXPECT_GT(rare, 60);
  EXPECT_LT(rare, 130);
}

TEST(HeldDirections, AreLooseAlongATunnelOnly) {
  Rng rng = test::test_rng(5);
  Points tunnel;
  for (int i = 0; i < 30000; ++i) {
    const auto along = static_cast<float>(rng.uniform(-30.0, 30.0));
    const auto across = static_cast<float>(rng.uniform(-4.0, 4.0));
    if (i % 2 == 0) {
      tunnel.emplace_back(along, across, -2.0F);
    } else {
      tunnel.emplace_back(along, i % 4 == 1 ? -4.0F : 4.0F, across + 2.0F);
    }
  }
  const SensorView view = view_of(tunnel, 1);
  const std::vector<ConstraintDirection> held = constraint_directions(view, view, {}, 0.3);
  ASSERT_EQ(held.size(), 6U);
  EXPECT_LT(held[0].strength, 0.03);
  EXPECT_GT(held[1].strength, 0.05);
  EXPECT_NEAR(std::abs(held[0].motion(3)), 1.0, 0.05);
  EXPECT_EQ(dof_names_of({held[0]}), "x");
}

TEST(DirectionBalance, WeighsDirectionsAlikeAtOne) {
  Correspondences pairs(100);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].target_normal = i < 90 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  }
  balanced_directions(1.0)(pairs);
  EXPECT_NEAR(90.0 * pairs.front().weight, 10.0 * pairs.back().weight, 1e-9);
  EXPECT_NEAR(90.0 * pairs.front().weight + 10.0 * pairs.back().weight, 100.0, 1e-9);
  balanced_directions(0.0)(pairs);
  EXPECT_EQ(pairs.front().weight, 1.0);
  EXPECT_EQ(pairs.back().weight, 1.0);
}

}  // namespace
}  // namespace croon
