#include "framework/geometry/pose_mean.hpp"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

constexpr PoseBounds kBounds = {0.01, 0.1};

std::vector<RigidTransform> poses_near(Rng& rng, const RigidTransform& pose, int count) {
  std::vector<RigidTransform> poses;
  for (int i = 0; i < count; ++i) poses.push_back(test::pose_near(rng, pose, 0.2, 0.03));
  return poses;
}

/// `good` poses near a random one, then `bad` ones anywhere.
std::vector<RigidTransform> poses_with_outliers(Rng& rng, int good, int bad) {
  std::vector<RigidTransform> poses = poses_near(rng, test::random_pose(rng, 3.0), good);
  for (int i = 0; i < bad; ++i) poses.push_back(test::random_pose(rng, 3.0));
  return poses;
}

std::vector<RigidTransform> shuffled(Rng& rng, std::vector<RigidTransform> poses) {
  for (std::size_t i = poses.size(); i > 1; --i) std::swap(poses[i - 1], poses[rng.below(i)]);
  return poses;
}

std::vector<RigidTransform> moved_from_left(const RigidTransform& T,
                                            std::vector<RigidTransform> poses) {
  for (RigidTransform& pose : poses) pose = T * pose;
  return poses;
}

void expect_near(const RigidTransform& a, const RigidTransform& b, double tolerance) {
  const PoseError error = pose_error(a, b);
  EXPECT_LT(error.rotation_rad, tolerance);
  EXPECT_LT(error.translation_m, tolerance);
}

TEST(MeanPose, OfEqualPosesIsThePose) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 200; ++i) {
    const RigidTransform pose = test::random_pose(rng, 10.0);
    expect_near(mean_pose({pose}), pose, 1e-12);
    expect_near(mean_pose({pose, pose, pose}), pose, 1e-12);
  }
}

TEST(MeanPose, LiesBetweenTwoThatDifferByATurn) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 200; ++i) {
    const RigidTransform middle = test::random_pose(rng, 10.0);
    const Eigen::Vector3d axis = test::random_pose(rng, 1.0).rotation.col(0);
    const Eigen::Matrix3d turn = rotation_exp(rng.uniform(0.0, 1.5) * axis);
    const Eigen::Vector3d shift = rng.uniform(0.0, 2.0) * axis;
    const RigidTransform one = {turn * middle.rotation, middle.translation + shift};
    const RigidTransform other = {turn.transpose() * middle.rotation, middle.translation - shift};
    expect_near(mean_pose({one, other}), middle, 1e-12);
  }
}

TEST(MeanPose, CommutesWithAMotionFromTheLeft) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 200; ++i) {
    const auto poses = poses_near(rng, test::random_pose(rng, 3.0), 20);
    const RigidTransform T = test::random_pose(rng, 3.0);
    expect_near(mean_pose(moved_from_left(T, poses)), T * mean_pose(poses), 1e-12);
  }
}

TEST(MeanPose, RotationCommutesWithATurnFromTheRight) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 200; ++i) {
    std::vector<RigidTransform> poses = poses_near(rng, test::random_pose(rng, 3.0), 20);
    const Eigen::Matrix3d mean = mean_pose(poses).rotation;
    const Eigen::Matrix3d R = test::random_pose(rng, 3.0).rotation;
    for (RigidTransform& pose : poses) pose.rotation = pose.rotation * R;
    EXPECT_LT(rotation_angle(mean_pose(poses).rotation.transpose() * (mean * R)), 1e-12);
  }
}

TEST(MeanPose, HasTheSameBitsInAnyOrder) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 100; ++i) {
    const auto poses = poses_with_outliers(rng, 12, 8);
    const RigidTransform mean = mean_pose(poses);
    const RigidTransform other = mean_pose(shuffled(rng, poses));
    EXPECT_EQ(mean.rotation, other.rotation);
    EXPECT_EQ(mean.translation, other.translation);
  }
}

TEST(MeanPose, OfNothingIsAMistakeOfOurs) {
  EXPECT_THROW(mean_pose({}), std::logic_error);
  EXPECT_THROW(consensus_pose({}, kBounds), std::logic_error);
}

TEST(ConsensusPose, IsTheMeanWhereAllAgree) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 100; ++i) {
    std::vector<RigidTransform> poses;
    const RigidTransform centre = test::random_pose(rng, 3.0);
    for (int k = 0; k < 30; ++k) poses.push_back(test::pose_near(rng, centre, 0.1, 0.02));
    expect_near(consensus_pose(poses, kBounds), mean_pose(poses), 1e-12);
  }
}

TEST(ConsensusPose, IsTheMeanOfItsMembers) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 100; ++i) {
    const auto poses = poses_with_outliers(rng, 12, 8);
    std::vector<RigidTransform> members;
    for (const std::size_t k : consensus_members(poses, kBounds)) members.push_back(poses[k]);
    expect_near(consensus_pose(poses, kBounds), mean_pose(members), 1e-12);
  }
  // Also those that are beyond the bounds of the mean, as the first is here.
  std::vector<RigidTransform> line(5);
  for (std::size_t k = 0; k < 5; ++k) {
    line[k].translation.x() = std::array{-0.95, 0.0, 0.0, 0.95, 0.95}[k] * kBounds.translation_m;
  }
  EXPECT_EQ(consensus_members(line, kBounds).size(), 5U);
  EXPECT_EQ(consensus_members({line[3]}, kBounds), std::vector<std::size_t>{0});
}

TEST(ConsensusPose, IgnoresHoweverManyThatAgreeWithNobody) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    const RigidTransform centre = test::random_pose(rng, 3.0);
    std::vector<RigidTransform> poses;
    for (int k = 0; k < 10; ++k) poses.push_back(test::pose_near(rng, centre, 0.1, 0.02));
    const RigidTransform without = consensus_pose(poses, kBounds);
    for (int k = 0; k < 30; ++k) poses.push_back(test::random_pose(rng, 3.0));
    expect_near(consensus_pose(shuffled(rng, poses), kBounds), without, 1e-12);
  }
}

TEST(ConsensusPose, IgnoresThoseThatLieOnOneSideButApartFromEachOther) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    const RigidTransform centre = test::random_pose(rng, 3.0);
    std::vector<RigidTransform> poses = poses_near(rng, centre, 10);
    for (int k = 0; k < 30; ++k) {
      const Eigen::Vector3d aside(5.0 + 0.3 * k, 0.0, 0.0);
      poses.push_back({centre.rotation, centre.translation + aside});
    }
    EXPECT_TRUE(agree(consensus_pose(shuffled(rng, poses), kBounds), centre, kBounds));
  }
}

TEST(ConsensusPose, IgnoresAMinorityThatAgreesOnSomethingElse) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    const RigidTransform centre = test::random_pose(rng, 3.0);
    // As in a street that looks the same in both directions.
    const RigidTransform wrong = {rotation_exp(kPi * Eigen::Vector3d::UnitZ()) * centre.rotation,
                                  centre.translation};
    std::vector<RigidTransform> poses = poses_near(rng, centre, 60);
    const auto minority = poses_near(rng, wrong, 40);
    poses.insert(poses.end(), minority.begin(), minority.end());
    EXPECT_TRUE(agree(consensus_pose(poses, kBounds), centre, {0.003, 0.02}));
  }
}

TEST(ConsensusPose, OfThousandsIsTheSameInAnyOrderAndNearTheMajority) {
  Rng rng = test::test_rng();
  const RigidTransform centre = test::random_pose(rng, 3.0);
  std::vector<RigidTransform> poses = poses_near(rng, centre, 5000);
  for (int k = 0; k < 4000; ++k) poses.push_back(test::random_pose(rng, 3.0));
  const RigidTransform consensus = consensus_pose(poses, kBounds);
  EXPECT_TRUE(agree(consensus, centre, {0.003, 0.02}));
  const RigidTransform other = consensus_pose(shuffled(rng, poses), kBounds);
  EXPECT_EQ(consensus.rotation, other.rotation);
  EXPECT_EQ(consensus.translation, other.translation);
}

TEST(ConsensusPose, CommutesWithAMotionFromTheLeft) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 100; ++i) {
    const auto poses = poses_with_outliers(rng, 12, 8);
    const RigidTransform T = test::random_pose(rng, 3.0);
    expect_near(consensus_pose(moved_from_left(T, poses), kBounds),
                T * consensus_pose(poses, kBounds), 1e-12);
  }
}

TEST(ConsensusPose, HasTheSameBitsInAnyOrder) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 100; ++i) {
    const auto poses = poses_with_outliers(rng, i % 3, 5);
    const RigidTransform consensus = consensus_pose(poses, kBounds);
    const RigidTransform other = consensus_pose(shuffled(rng, poses), kBounds);
    EXPECT_EQ(consensus.rotation, other.rotation);
    EXPECT_EQ(consensus.translation, other.translation);
  }
}

TEST(ConsensusPose, BoundsOfZeroLeaveThePoseThatIsMetMostOften) {
  Rng rng = test::test_rng();
  const RigidTransform often = test::random_pose(rng, 3.0);
  const RigidTransform seldom = test::random_pose(rng, 3.0);
  expect_near(consensus_pose({seldom, often, often}, {0.0, 0.0}), often, 1e-12);
}

TEST(ConsensusPose, APoseWithMoreVotesWins) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 20; ++i) {
    const RigidTransform a = test::random_pose(rng, 1.0), b = test::random_pose(rng, 1.0);
    EXPECT_LT(pose_error(consensus_pose({a, b}, kBounds, {50.0, 3.0}), a).translation_m, 1e-12);
    EXPECT_LT(pose_error(consensus_pose({b, a}, kBounds, {50.0, 3.0}), b).translation_m, 1e-12);
    EXPECT_LT(pose_error(consensus_pose({b, a, b}, kBounds, {3.0, 50.0, 3.0}), a).translation_m,
              1e-12);
  }
  EXPECT_THROW(consensus_pose({RigidTransform()}, kBounds, {1.0, 2.0}), std::logic_error);
}

/// The information of an observation with these standard deviations of all six.
Matrix6d information_of(double std) { return Matrix6d::Identity() / (std * std); }

TEST(CommonStart, IsThePoseThatMostScenesAreNearAndOneAloneToTheLastBit) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    const std::vector<RigidTransform> poses = poses_with_outliers(rng, 5, 2);
    expect_near(common_start(poses), consensus_pose(poses, kNearStart), 1e-12);
    expect_near(common_start(poses), poses.front(), 0.05);
    EXPECT_EQ(common_start({poses[0]}).rotation, poses[0].rotation);
    EXPECT_EQ(common_start({poses[0]}).translation, poses[0].translation);
  }
  EXPECT_THROW(common_start({}), std::logic_error);
}

TEST(InformedMean, OfEquallyKnownPosesIsTheirMean) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    std::vector<InformedPose> informed;
    const std::vector<RigidTransform> poses = poses_near(rng, test::random_pose(rng, 3.0), 5);
    for (const RigidTransform& pose : poses) informed.push_back({pose, information_of(0.1)});
    const InformedPose mean = informed_mean(informed);
    expect_near(mean.pose, mean_pose(poses), 1e-5);
    EXPECT_LT((mean.information - 5.0 * information_of(0.1)).norm(), 1e-9);
  }
}

TEST(InformedMean, TakesEachDirectionFromThePoseThatKnowsIt) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    const RigidTransform one = test::random_pose(rng, 3.0);
    const RigidTransform other = test::pose_near(rng, one, 0.2, 0.03);
    Matrix6d knows_x = information_of(1e-1), knows_others = information_of(1e-4);
    const auto x = static_cast<Eigen::Index>(Dof::x);
    knows_x(x, x) = 1e8;
    knows_others(x, x) = 1e2;
    const InformedPose mean = informed_mean({{one, knows_x}, {other, knows_others}});
    EXPECT_NEAR(mean.pose.translation.x(), one.translation.x(), 1e-6);
    EXPECT_NEAR(mean.pose.translation.y(), other.translation.y(), 1e-6);
    EXPECT_LT(pose_error(mean.pose, other).rotation_rad, 1e-6);
  }
}

TEST(InformedMean, OfOnePoseIsThePoseToTheLastBit) {
  Rng rng = test::test_rng();
  const RigidTransform pose = test::random_pose(rng, 3.0);
  EXPECT_EQ(informed_mean({{pose, information_of(0.1)}}).pose.rotation, pose.rotation);
  EXPECT_THROW(informed_mean({}), std::logic_error);
}

TEST(Agree, CountsTheBoundItselfAndIsSymmetric) {
  const RigidTransform a;
  const RigidTransform b = {Eigen::Matrix3d::Identity(), {0.1, 0.0, 0.0}};
  EXPECT_TRUE(agree(a, b, {0.01, 0.1}));
  EXPECT_TRUE(agree(b, a, {0.01, 0.1}));
  EXPECT_FALSE(agree(a, b, {0.01, 0.0999}));
  const RigidTransform turned = {rotation_exp({0.0, 0.02, 0.0}), {0.0, 0.0, 0.0}};
  EXPECT_FALSE(agree(a, turned, {0.0199, 0.1}));
  EXPECT_TRUE(agree(a, turned, {0.0201, 0.1}));
}

}  // namespace
}  // namespace croon
