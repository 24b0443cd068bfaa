#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/registration/azimuth_error.hpp"
#include "framework/stage/rig_step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

const AzimuthError kError = {rad_from_deg(0.2), rad_from_deg(0.5), rad_from_deg(-0.4), 0.012};

/// What a sensor with `error` reports instead of `point`: the fixed point of its correction.
Eigen::Vector3d with_error(const Eigen::Vector3d& point, const AzimuthError& error) {
  Eigen::Vector3d reported = point;
  for (int i = 0; i < 20; ++i) {
    const double angle = error.at(reported);
    reported = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) * point;
  }
  return reported;
}

Points with_error(Points points, const AzimuthError& error) {
  for (Eigen::Vector3f& point : points) {
    point = with_error(point.cast<double>(), error).cast<float>();
  }
  return points;
}

/// Two streets, seen by a sensor whose azimuths have `error` and whose start is near its pose.
std::vector<RigEstimate> two_streets(const AzimuthError& error, const RigidTransform& T) {
  Rng rng = test::test_rng();
  std::vector<RigEstimate> rig;
  for (std::uint64_t i = 0; i < 2; ++i) {
    const test::StreetPair pair = test::street_pair(rng, i, T, 30000, 12000, 0.01);
    const RigidTransform start = test::pose_near(rng, T, 0.1, 0.02);
    rig.push_back({std::to_string(i), "top", "left",
                   test::estimate_of(pair.target, with_error(pair.source, error), start)});
  }
  return rig;
}

void calibrate(std::vector<RigEstimate>& rig, const std::string& parameters = "") {
  Rng rng = test::test_rng();
  const auto step = test::stage<Step>(R"({"step": "azimuth_calibration")" + parameters + "}");
  dynamic_cast<const RigStep&>(*step).adjust(rig, rng);
}

RigidTransform some_pose() {
  Rng rng = test::test_rng(3);
  return test::random_pose(rng, 0.5);
}

TEST(AzimuthError, IsTakenAwayFromWhatASensorReports) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d point = test::random_pose(rng, 50.0).translation;
    const Eigen::Vector3d reported = with_error(point, kError);
    EXPECT_LT((without_error(reported, kError) - point).norm(), 1e-9);
    EXPECT_NEAR(reported.norm(), point.norm(), 1e-9);
    EXPECT_EQ(reported.z(), point.z());
  }
  // On the axis there is no azimuth.
  EXPECT_EQ(without_error(Eigen::Vector3d(0, 0, 3), kError), Eigen::Vector3d(0, 0, 3));
}

TEST(AzimuthCalibration, FindsTheErrorThatScenesHaveInCommon) {
  const RigidTransform T = some_pose();
  std::vector<RigEstimate> rig = two_streets(kError, T);
  calibrate(rig);
  for (const RigEstimate& one : rig) {
    ASSERT_EQ(one.failure, "");
    const auto number = [&](const std::string& name) {
      return test::diagnostic(one.estimate, name);
    };
    EXPECT_EQ(number("corrected"), 1.0);
    EXPECT_EQ(number("converged"), 1.0);
    EXPECT_LT(number("rmse_m"), number("rmse_before_m"));
    EXPECT_NEAR(number("azimuth_sine_deg"), 0.5, 4.0 * number("azimuth_sine_std_deg"));
    EXPECT_NEAR(number("azimuth_cosine_deg"), -0.4, 4.0 * number("azimuth_cosine_std_deg"));
    EXPECT_NEAR(number("azimuth_slope"), 0.012, 4.0 * number("azimuth_slope_std"));
    EXPECT_LT(number("azimuth_sine_std_deg"), 0.1);
    EXPECT_LT(number("azimuth_cosine_std_deg"), 0.1);
    // A mean error is a yaw of the mounting.
    const PoseError error = pose_error(one.estimate.T_target_source, T);
    EXPECT_LT(error.translation_m, 0.02);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.4);
  }
  EXPECT_EQ(test::diagnostic(rig[0].estimate, "azimuth_sine_deg"),
            test::diagnostic(rig[1].estimate, "azimuth_sine_deg"));
}

TEST(AzimuthCalibration, LeavesASensorWithoutAnErrorAsItIs) {
  const std::vector<RigEstimate> before = two_streets({}, some_pose());
  std::vector<RigEstimate> after = before;
  calibrate(after);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(test::diagnostic(after[i].estimate, "corrected"), 0.0);
    EXPECT_EQ(after[i].estimate.source, before[i].estimate.source);
    EXPECT_EQ(after[i].estimate.T_target_source.rotation,
              before[i].estimate.T_target_source.rotation);
    EXPECT_EQ(after[i].estimate.T_target_source.translation,
              before[i].estimate.T_target_source.translation);
  }
}

TEST(AzimuthCalibration, LeavesASensorThatSeesFewSurfacesAsItIs) {
  Rng rng = test::test_rng();
  Points corner;  // Three walls in one cube of 8 m.
  for (int i = 0; i < 9000; ++i) {
    Eigen::Vector3d point = Eigen::Vector3d::Constant(1.0 + 1e-4 * rng.normal());
    point((i + 1) % 3) = rng.uniform(1.0, 7.0);
    point((i + 2) % 3) = rng.uniform(1.0, 7.0);
    corner.push_back(point.cast<float>());
  }
  std::vector<RigEstimate> rig(1);
  rig[0] = {"a", "top", "left", test::estimate_of(corner, with_error(corner, kError), {})};
  const auto source = rig[0].estimate.source;
  calibrate(rig);
  EXPECT_LT(test::diagnostic(rig[0].estimate, "surfaces"), 10.0);
  EXPECT_EQ(test::diagnostic(rig[0].estimate, "azimuth_significance"), 0.0);
  EXPECT_EQ(rig[0].estimate.source, source);
}

TEST(AzimuthCalibration, CorrectsWhatIsKnown) {
  const RigidTransform T = some_pose();
  const std::vector<RigEstimate> right = two_streets({}, T);
  std::vector<RigEstimate> rig = two_streets(kError, T);
  const std::string error =
      R"({"offset_deg": 0.2, "sine_deg": 0.5, "cosine_deg": -0.4, "slope": 0.012})";
  calibrate(rig, R"(, "known": {"left": )" + error + R"(, "top": )" + error + "}");
  for (std::size_t i = 0; i < rig.size(); ++i) {
    const Estimate& estimate = rig[i].estimate;
    const Points& points = estimate.source->points();
    for (std::size_t k = 0; k < points.size(); k += 10) {
      EXPECT_LT((points[k] - right[i].estimate.source->points()[k]).norm(), 1e-4);
    }
    const Eigen::Vector3d of_target = right[i].estimate.target->points()[7].cast<double>();
    EXPECT_LT(
        (estimate.target->points()[7].cast<double>() - without_error(of_target, kError)).norm(),
        1e-5);
    EXPECT_TRUE(estimate.diagnostics.empty());
  }
}

TEST(AzimuthCalibration, CorrectsWhatIsKnownOfRejectedPosesToo) {
  std::vector<RigEstimate> rig = two_streets(kError, some_pose());
  rig.resize(1, rig.front());
  rig.push_back(rig.front());
  rig.back().source = "right";
  rig.front().estimate.rejection = "no";
  calibrate(rig, R"(, "estimate": false, "known": {"top": {"sine_deg": 0.5}})");
  // All sensors of a scene share the reference's cloud.
  EXPECT_EQ(rig.front().estimate.target, rig.back().estimate.target);
  EXPECT_EQ(rig.front().estimate.rejection, "no");
}

TEST(AzimuthCalibration, FailsAloneWhereTooFewPointsCorrespond) {
  std::vector<RigEstimate> rig = two_streets({}, some_pose());
  rig.front().source = "right";
  rig.front().estimate.T_target_source.translation.x() += 1000.0;
  calibrate(rig);
  EXPECT_EQ(rig.front().failure, "only 0 points correspond");
  EXPECT_EQ(rig.back().failure, "");
}

TEST(AzimuthCalibration, ASceneThatWentAstrayDoesNotSpoilTheOthers) {
  std::vector<RigEstimate> rig = two_streets(kError, some_pose());
  std::vector<RigEstimate> alone = {rig.back()};
  rig.front().estimate.T_target_source.translation.x() += 1000.0;
  calibrate(rig);
  calibrate(alone);
  EXPECT_EQ(rig.front().failure, "only 0 points correspond");
  ASSERT_EQ(rig.back().failure, "");
  const PoseError apart =
      pose_error(rig.back().estimate.T_target_source, alone.front().estimate.T_target_source);
  EXPECT_LT(deg_from_rad(apart.rotation_rad), 0.1);
  EXPECT_LT(apart.translation_m, 0.01);
}

}  // namespace
}  // namespace croon
