#include "framework/registration/plane_cost.hpp"

#include <gtest/gtest.h>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

constexpr std::size_t kSensors = 3;

/// Planes that all sensors see, at poses that are drawn too.
struct PlanesInView {
  std::vector<RigidTransform> poses;
  std::vector<PlanePatch> patches;
};

/// Each of `count` planes has 20 points of each sensor, `noise_m` off it.
PlanesInView planes_in_view(Rng& rng, int count, double noise_m) {
  PlanesInView made;
  for (std::size_t k = 0; k < kSensors; ++k) made.poses.push_back(test::random_pose(rng, 2.0));
  for (int i = 0; i < count; ++i) {
    const RigidTransform T_common_plane = test::random_pose(rng, 10.0);
    PlanePatch patch;
    for (std::size_t k = 0; k < kSensors; ++k) {
      PlanePatch::View view;
      view.sensor = k;
      for (int n = 0; n < 20; ++n) {
        Eigen::Vector3d point;
        for (int axis = 0; axis < 3; ++axis) point(axis) = rng.uniform(-1.0, 1.0);
        point.z() *= noise_m;
        view.sums.add(made.poses[k].inverse() * (T_common_plane * point));
      }
      patch.own_cost += min_eigenvalue(view.sums.scatter());
      patch.views.push_back(view);
    }
    made.patches.push_back(patch);
  }
  return made;
}

/// The poses after a step of all of them, turned about their own origins.
std::vector<RigidTransform> stepped(std::vector<RigidTransform> poses,
                                    const Eigen::VectorXd& step) {
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Vector6d own = step.segment<6>(static_cast<Eigen::Index>(6 * k));
    poses[k] = {rotation_exp(own.head<3>()) * poses[k].rotation,
                poses[k].translation + own.tail<3>()};
  }
  return poses;
}

Eigen::VectorXd random_step(Rng& rng, double size) {
  Eigen::VectorXd step(6 * static_cast<Eigen::Index>(kSensors));
  for (double& part : step) part = rng.uniform(-size, size);
  return step;
}

/// The derivatives with respect to the poses of all sensors, and then to the velocity, if any.
BlockSystem derivatives(const std::vector<PlanePatch>& patches, const RigState& state,
                        double kernel_width) {
  std::vector<Block> poses;
  Eigen::Index unknowns = 0;
  for (std::size_t k = 0; k < kSensors; ++k) poses.push_back(appended_block(6, unknowns));
  return bundle_cost(patches, state, kernel_width, poses);
}

TEST(PlaneCost, IsTheSquaredDistanceToTheBestPlaneLessThatOfEachSensor) {
  Rng rng = test::test_rng();
  const PlanesInView made = planes_in_view(rng, 20, 0.0);
  for (const PlanePatch& patch : made.patches) {
    EXPECT_NEAR(plane_cost_value(patch, {made.poses}), 0.0, 1e-9);
    // Moved by 0.1 m along its normal, a third of the points leaves a cost of n (0.1 m)^2 2 / 9.
    PlaneCost cost;
    plane_cost(patch, {made.poses}, cost);
    std::vector<RigidTransform> poses = made.poses;
    poses[1].translation += 0.1 * cost.normal;
    EXPECT_NEAR(plane_cost_value(patch, {poses}), 60 * 0.01 * 2.0 / 9.0, 0.02);
  }
}

TEST(PlaneCost, IsNeverNegative) {
  Rng rng = test::test_rng();
  const PlanesInView made = planes_in_view(rng, 50, 0.2);
  for (int i = 0; i < 20; ++i) {
    const auto poses = stepped(made.poses, random_step(rng, 0.3));
    for (const PlanePatch& patch : made.patches) EXPECT_GE(plane_cost_value(patch, {poses}), 0.0);
  }
}

TEST(PlaneCost, TheTruthIsTheLeastOnPlanesWithoutNoise) {
  Rng rng = test::test_rng();
  const PlanesInView made = planes_in_view(rng, 30, 0.0);
  EXPECT_NEAR(bundle_value(made.patches, {made.poses}, 3.0), 0.0, 1e-9);
  EXPECT_LT(derivatives(made.patches, {made.poses}, 3.0).gradient.norm(), 1e-6);
  for (int i = 0; i < 50; ++i) {
    const auto poses = stepped(made.poses, random_step(rng, 0.01));
    EXPECT_GT(bundle_value(made.patches, {poses}, 3.0), 1e-3);
  }
}

TEST(BundleCost, HasTheDerivativesOfItsValue) {
  Rng rng = test::test_rng();
  const PlanesInView made = planes_in_view(rng, 12, 0.05);
  for (const double kernel_width : {0.5, 3.0, 1e6}) {
    const auto poses = stepped(made.poses, random_step(rng, 0.02));
    const auto value = [&](const Eigen::VectorXd& step) {
      return bundle_value(made.patches, {stepped(poses, step)}, kernel_width);
    };
    const double now = bundle_value(made.patches, {poses}, kernel_width);
    const BlockSystem cost = derivatives(made.patches, {poses}, kernel_width);
    EXPECT_NEAR((cost.hessian - cost.hessian.transpose()).norm(), 0.0, 1e-9 * cost.hessian.norm());
    for (int i = 0; i < 20; ++i) {
      const Eigen::VectorXd direction = random_step(rng, 1.0);
      constexpr double kShort = 1e-6, kLong = 1e-4;
      const double slope =
          (value(kShort * direction) - value(-kShort * direction)) / (2.0 * kShort);
      EXPECT_NEAR(cost.gradient.dot(direction), slope, 1e-5 * cost.gradient.norm());
      const double curvature =
          (value(kLong * direction) - 2.0 * now + value(-kLong * direction)) / (kLong * kLong);
      EXPECT_NEAR(direction.dot(cost.hessian * direction), curvature, 1e-4 * cost.hessian.norm());
    }
  }
}

/// A point, when it was measured, and by whom.
struct TimedPoint {
  std::size_t sensor;
  Eigen::Vector3d point;
  double time_s;
};

/// The patch of these points after they have moved with the common frame's `velocity`.
PlanePatch patch_of(const std::vector<TimedPoint>& points, const std::vector<RigidTransform>& poses,
                    const Twist& velocity) {
  PlanePatch patch;
  for (std::size_t k = 0; k < kSensors; ++k) {
    PlanePatch::View view;
    view.sensor = k;
    for (const TimedPoint& one : points) {
      if (one.sensor != k) continue;
      const Eigen::Vector3d common = poses[k] * one.point;
      const Eigen::Vector3d moved =
          common + one.time_s * (velocity.linear_mps + velocity.angular_radps.cross(common));
      const Eigen::Vector3d own = poses[k].inverse() * moved;
      view.sums.add(own);
      view.timed.add(own, one.time_s);
      view.timed_twice.add(own, one.time_s * one.time_s);
    }
    patch.views.push_back(view);
  }
  return patch;
}

TEST(BundleCost, FollowsTheVelocityAsIfThePointsHadMoved) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 20; ++i) {
    std::vector<RigidTransform> poses;
    for (std::size_t k = 0; k < kSensors; ++k) poses.push_back(test::random_pose(rng, 2.0));
    std::vector<TimedPoint> points;
    for (int n = 0; n < 60; ++n) {
      Eigen::Vector3d point;
      for (int axis = 0; axis < 3; ++axis) point(axis) = rng.uniform(-1.0, 1.0);
      point.z() *= 0.05;
      const double time_s = rng.uniform(-0.1, 0.1);
      points.push_back({static_cast<std::size_t>(n) % kSensors, point, time_s});
    }
    const Vector6d direction = random_step(rng, 1.0).head<6>();
    const auto velocity = [&](double size) {
      return Twist{size * direction.head<3>(), size * direction.tail<3>()};
    };
    const std::vector<PlanePatch> patches = {patch_of(points, poses, {})};
    const auto value = [&](double size) {
      return bundle_value(patches, {poses, velocity(size)}, 3.0);
    };
    EXPECT_NEAR(value(0.5), bundle_value({patch_of(points, poses, velocity(0.5))}, {poses}, 3.0),
                1e-9);
    const BlockSystem cost = derivatives(patches, {poses, Twist()}, 3.0);
    constexpr double kShort = 1e-5, kLong = 1e-2;
    const Vector6d gradient = cost.gradient.tail(6);
    EXPECT_NEAR(gradient.dot(direction), (value(kShort) - value(-kShort)) / (2.0 * kShort),
                1e-5 * gradient.norm() + 1e-9);
    const double curvature = (value(kLong) - 2.0 * value(0.0) + value(-kLong)) / (kLong * kLong);
    const Matrix6d hessian = cost.hessian.bottomRightCorner(6, 6);
    EXPECT_NEAR(direction.dot(hessian * direction), curvature, 1e-3 * hessian.norm());
  }
}

TEST(BundleCost, ASensorWithAConstantPoseHasNoDerivatives) {
  Rng rng = test::test_rng();
  const PlanesInView made = planes_in_view(rng, 12, 0.05);
  const RigState state = {stepped(made.poses, random_step(rng, 0.02))};
  const BlockSystem all = derivatives(made.patches, state, 3.0);
  std::vector<Block> poses(kSensors);  // All constant.
  Eigen::Index unknowns = 0;
  for (std::size_t k = 1; k < kSensors; ++k) poses[k] = appended_block(6, unknowns);
  const BlockSystem others = bundle_cost(made.patches, state, 3.0, poses);
  EXPECT_EQ(others.gradient, all.gradient.tail(unknowns));
  EXPECT_EQ(others.hessian, all.hessian.bottomRightCorner(unknowns, unknowns));
}

TEST(BundleCost, DoesNotChangeIfAllMoveTogether) {
  Rng rng = test::test_rng();
  const PlanesInView made = planes_in_view(rng, 20, 0.1);
  const auto poses = stepped(made.poses, random_step(rng, 0.02));
  const double before = bundle_value(made.patches, {poses}, 3.0);
  const Eigen::VectorXd gradient = derivatives(made.patches, {poses}, 3.0).gradient;
  const RigidTransform motion = test::random_pose(rng, 5.0);
  std::vector<RigidTransform> together;
  for (const RigidTransform& T : poses) together.push_back(motion * T);
  EXPECT_NEAR(bundle_value(made.patches, {together}, 3.0), before, 1e-8 * before);
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (Eigen::Index at = 3; at < gradient.size(); at += 6) shift += gradient.segment<3>(at);
  EXPECT_NEAR(shift.norm(), 0.0, 1e-8 * gradient.norm());
}

}  // namespace
}  // namespace croon
