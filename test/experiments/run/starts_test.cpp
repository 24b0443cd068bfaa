#include "experiments/run/starts.hpp"

#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

StartRule swept(const Sweep& sweep) {
  StartRule rule{StartCentre::truth, 0.0, 0.0, sweep.levels};
  rule.sweep = sweep;
  return rule;
}

bool is_same(const RigidTransform& a, const RigidTransform& b) {
  return a.rotation == b.rotation && a.translation == b.translation;
}

TEST(Starts, MoveTheCentreWithinTheRangesAndFillThem) {
  Rng rng = test::test_rng();
  const StartRule rule{StartCentre::truth, 45.0, 0.1, 1};
  Vector6d low = Vector6d::Zero(), high = Vector6d::Zero(), sum = Vector6d::Zero();
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RigidTransform centre = test::random_pose(rng, 3.0);
    const RigidTransform start = draw_start(rule, centre, 1, "scene", "left", trial);
    const Vector6d offset = pose_error(start, centre).dof;
    low = low.cwiseMin(offset);
    high = high.cwiseMax(offset);
    sum += offset;
  }
  for (int i = 0; i < 6; ++i) {
    const double half_range = i < 3 ? rad_from_deg(45.0) : 0.1;
    EXPECT_LE(high(i), half_range * (1 + 1e-12));
    EXPECT_GE(low(i), -half_range * (1 + 1e-12));
    EXPECT_GT(high(i), 0.99 * half_range);
    EXPECT_LT(low(i), -0.99 * half_range);
    // The mean of n uniform draws has a standard deviation of half_range / sqrt(3 n): five of them.
    EXPECT_LT(std::abs(sum(i) / kTrials), 5.0 * half_range / std::sqrt(3.0 * kTrials));
  }
}

TEST(Starts, DependOnSeedSceneSensorAndTrialAlone) {
  Rng rng = test::test_rng();
  const RigidTransform centre = test::random_pose(rng, 3.0);
  StartRule rule{StartCentre::truth, 45.0, 0.1, 10};
  const Start start = draw_start(rule, centre, 1, "a", "left", 3);
  rule.trials = 20;
  rule.around = StartCentre::nominal;
  EXPECT_TRUE(is_same(start, draw_start(rule, centre, 1, "a", "left", 3)));
  EXPECT_FALSE(is_same(start, draw_start(rule, centre, 2, "a", "left", 3)));
  EXPECT_FALSE(is_same(start, draw_start(rule, centre, 1, "b", "left", 3)));
  EXPECT_FALSE(is_same(start, draw_start(rule, centre, 1, "a", "right", 3)));
  EXPECT_FALSE(is_same(start, draw_start(rule, centre, 1, "a", "left", 4)));
  // Words are parts of the stream's name, not one long word.
  EXPECT_FALSE(is_same(draw_start(rule, centre, 1, "ab", "c", 0),
                       draw_start(rule, centre, 1, "a", "bc", 0)));
}

TEST(Starts, WithoutRangesAreTheCentre) {
  Rng rng = test::test_rng();
  const RigidTransform centre = test::random_pose(rng, 3.0);
  const RigidTransform start =
      draw_start({StartCentre::truth, 0.0, 0.0, 1}, centre, 1, "a", "b", 0);
  EXPECT_LT((start.rotation - centre.rotation).norm(), 1e-14);
  EXPECT_EQ(start.translation, centre.translation);
}

/// Moments of the uniform distribution on SO(3): each entry of R has mean 0 and variance 1/3,
/// entries do not correlate, and the rotation's angle has the density (1 - cos a) / pi (mean pi/2 +
/// 2/pi).
TEST(Starts, AnyRotationIsUniform) {
  const StartRule rule{StartCentre::truth, 180.0, 0.1, 1};
  Rng rng = test::test_rng();
  const RigidTransform centre = test::random_pose(rng, 3.0);
  constexpr int kTrials = 20000;
  using Vector9d = Eigen::Matrix<double, 9, 1>;
  Vector9d mean = Vector9d::Zero();
  Eigen::Matrix<double, 9, 9> square = Eigen::Matrix<double, 9, 9>::Zero();
  double angle = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RigidTransform start = draw_start(rule, centre, 1, "scene", "left", trial);
    const Eigen::Matrix3d R = start.rotation * centre.rotation.transpose();
    EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
    EXPECT_LE((start.translation - centre.translation).cwiseAbs().maxCoeff(), 0.1);
    const Vector9d entries = Eigen::Map<const Vector9d>(R.data());
    mean += entries / kTrials;
    square += entries * entries.transpose() / kTrials;
    angle += rotation_angle(R) / kTrials;
  }
  const double tolerance = 5.0 / std::sqrt(static_cast<double>(kTrials));
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT((square - Eigen::Matrix<double, 9, 9>::Identity() / 3.0).cwiseAbs().maxCoeff(),
            tolerance);
  EXPECT_NEAR(angle, kPi / 2.0 + 2.0 / kPi, tolerance);
}

TEST(Starts, OfASweepTurnByTheirLevel) {
  Rng rng = test::test_rng();
  const Sweep sweep{SweepOf::rotation, 0.0, 180.0, 7};
  Eigen::Vector3d axes = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  constexpr int kTrials = 7 * 2000;
  int turned = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RigidTransform centre = test::random_pose(rng, 3.0);
    const RigidTransform start = draw_start(swept(sweep), centre, 1, "scene", "left", trial);
    const Eigen::Matrix3d R = start.rotation * centre.rotation.transpose();
    const double angle_deg = 30.0 * (trial % 7);
    EXPECT_NEAR(rotation_angle(R), rad_from_deg(angle_deg), 1e-7);
    EXPECT_EQ(start.translation, centre.translation);
    if (angle_deg == 0.0 || angle_deg == 180.0) continue;
    const Eigen::Vector3d axis = Eigen::AngleAxisd(R).axis();
    axes += axis;
    square += axis * axis.transpose();
    ++turned;
  }
  // Uniform on the sphere: mean 0, covariance 1/3.
  const double tolerance = 5.0 / std::sqrt(static_cast<double>(turned));
  EXPECT_LT((axes / turned).norm(), tolerance);
  EXPECT_LT((square / turned - Eigen::Matrix3d::Identity() / 3.0).norm(), tolerance);
}

TEST(Starts, OfASweepMoveByTheirLevelAndTurnByTheRange) {
  Rng rng = test::test_rng();
  StartRule rule = swept({SweepOf::translation, 1.0, 5.0, 5});
  rule.rotation_deg = 10.0;
  double largest = 0.0;
  for (int trial = 0; trial < 500; ++trial) {
    const RigidTransform centre = test::random_pose(rng, 3.0);
    const RigidTransform start = draw_start(rule, centre, 1, "scene", "left", trial);
    EXPECT_NEAR((start.translation - centre.translation).norm(), 1.0 + trial % 5, 1e-12);
    const Vector6d offset = pose_error(start, centre).dof;
    largest = std::max(largest, offset.head<3>().cwiseAbs().maxCoeff());
  }
  EXPECT_LE(largest, rad_from_deg(10.0) * (1.0 + 1e-9));
  EXPECT_GT(largest, rad_from_deg(9.5));
}

TEST(Starts, StayWithinTheRangeOfEachAxis) {
  StartRule rule;
  rule.rotation_deg.values = {1.0, 0.0, 20.0};
  rule.translation_m.values = {0.0, 2.0, 0.5};
  Vector6d largest = Vector6d::Zero();
  for (int trial = 0; trial < 1000; ++trial) {
    const RigidTransform start = draw_start(rule, RigidTransform{}, 1, "scene", "left", trial);
    Vector6d offset;
    offset << rpy_from_rotation(start.rotation), start.translation;
    largest = largest.cwiseMax(offset.cwiseAbs());
  }
  Vector6d ranges;
  ranges << rad_from_deg(1.0), 0.0, rad_from_deg(20.0), 0.0, 2.0, 0.5;
  for (int i = 0; i < 6; ++i) {
    EXPECT_LE(largest(i), ranges(i) + 1e-12) << i;
    EXPECT_GE(largest(i), 0.95 * ranges(i)) << i;
  }
}

TEST(Starts, NeedTheirCentreInEveryScene) {
  const CalibratedPair left = {{"left", "left", "top"}, {}, RigidTransform{}, {}};
  const CalibratedPair right = {{"right", "right", "top"}, RigidTransform{}, {}, {}};
  std::vector<SceneGroup> groups;
  for (const char* name : {"a", "b", "c", "d", "e"})
    groups.push_back({name, "", {{}}, {left, right}});
  groups[4].pairs[0].truth = RigidTransform{};
  Experiment experiment;
  experiment.starts_file = "x.json";
  try {
    resolve_starts(experiment, groups, "");
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1U);
    EXPECT_EQ(error.faults()[0].line(),
              "x.json: /starts/around: sensor \"left\" has no truth pose to draw starts around in "
              "scenes a, b, c and 1 more; it has \"nominal\"");
  }
  experiment.starts.around = StartCentre::initial;
  try {
    resolve_starts(experiment, groups, "");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 2U);
  }
  experiment.starts.is_none = true;
  EXPECT_NO_THROW(resolve_starts(experiment, groups, ""));
  EXPECT_TRUE(is_same(start_of(experiment, "a", right, 0), RigidTransform{}));
}

TEST(Starts, OfDataWithoutPosesAreSaidToBeNone) {
  Experiment experiment;
  try {
    resolve_starts(experiment, {{"a", "", {{}}, {{{"left", "left", "top"}, {}, {}, {}}}}}, "");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(error.faults()[0].message.find("\"starts\": \"none\" needs no pose"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace croon::experiments
