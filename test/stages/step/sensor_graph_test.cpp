#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/rig_step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

/// A street seen by the reference "top", by "side", whose pose is known, and by "rear", whose pose
/// was rejected because "top" sees nothing of what it sees.
struct StreetRig {
  RigidTransform T_top_side, T_top_rear;
  std::vector<RigEstimate> estimates;

  RigEstimate& side() { return estimates[0]; }
  RigEstimate& rear() { return estimates[1]; }
};

PoseCovariance small_covariance() { return {1e-6 * Matrix6d::Identity(), {}}; }

std::shared_ptr<const Cloud> named_cloud(const Points& points, const char* name) {
  return std::make_shared<const Cloud>(points, StreamKey(3).with(name));
}

/// A cloud that no other one overlaps.
std::shared_ptr<const Cloud> too_few_points() {
  return named_cloud(Points(3, {1.0F, 0.0F, 0.0F}), "too few");
}

StreetRig street_rig() {
  Rng rng = test::test_rng();
  StreetRig rig;
  rig.T_top_side = {rotation_from_rpy(Eigen::Vector3d(0.02, -0.03, 0.9)), {0.5, 0.8, -0.3}};
  rig.T_top_rear = {rotation_from_rpy(Eigen::Vector3d(0.01, 0.04, 2.8)), {-1.5, 0.2, -0.4}};
  constexpr int kPoints = 12000;
  const test::StreetPair side = test::street_pair(rng, 4, rig.T_top_side, kPoints, kPoints, 0.01);
  const test::StreetPair rear = test::street_pair(rng, 4, rig.T_top_rear, kPoints, kPoints, 0.01);
  const auto top = named_cloud(side.target, "top");
  for (const auto& [name, pair] : {std::pair("side", side), std::pair("rear", rear)}) {
    rig.estimates.push_back({"0", "top", name, {}});
    rig.estimates.back().estimate.target = top;
    rig.estimates.back().estimate.source = named_cloud(pair.source, name);
  }
  rig.side().estimate.T_target_source = rig.T_top_side;
  rig.side().estimate.covariance = small_covariance();
  rig.rear().estimate.target = too_few_points();
  rig.rear().estimate.T_target_source.translation = {40.0, 0.0, 0.0};
  rig.rear().estimate.covariance = small_covariance();
  rig.rear().estimate.rejection = "verdict: too little overlap";
  return rig;
}

void connect(std::vector<RigEstimate>& rig, const std::string& json = "") {
  Rng rng = test::test_rng();
  const auto step = test::stage<Step>(R"({"step": "sensor_graph")" + json + "}");
  dynamic_cast<const RigStep&>(*step).adjust(rig, rng);
}

void expect_connected(const StreetRig& rig) {
  const RigEstimate& rear = rig.estimates[1];
  EXPECT_EQ(rear.failure, "");
  EXPECT_FALSE(rear.estimate.rejection) << *rear.estimate.rejection;
  ASSERT_TRUE(rear.estimate.covariance);
  const PoseError error = pose_error(rear.estimate.T_target_source, rig.T_top_rear);
  EXPECT_LT(deg_from_rad(error.rotation_rad), 0.1);
  EXPECT_LT(error.translation_m, 0.02);
}

TEST(SensorGraph, ConnectsARejectedSensorByWayOfAnother) {
  StreetRig rig = street_rig();
  connect(rig.estimates);
  expect_connected(rig);
  EXPECT_EQ(rig.side().estimate.T_target_source, rig.T_top_side);
}

TEST(SensorGraph, ConnectsARejectedSensorToTheReference) {
  StreetRig rig = street_rig();
  rig.rear().estimate.target = rig.side().estimate.target;
  rig.side().estimate.rejection = "verdict: too little overlap";
  connect(rig.estimates);
  expect_connected(rig);
}

TEST(SensorGraph, ConnectsASensorWhoseStepsFailed) {
  StreetRig rig = street_rig();
  rig.rear().failure = "global_alignment: no pose was found at which the clouds agree";
  rig.rear().estimate.rejection.reset();
  connect(rig.estimates);
  expect_connected(rig);
}

TEST(SensorGraph, NamesAPartThatIsNotConnectedToTheReference) {
  StreetRig rig = street_rig();
  rig.side().estimate.target = too_few_points();
  rig.side().estimate.rejection = "verdict: too little overlap";
  rig.rear().failure = "global_alignment: no pose was found at which the clouds agree";
  rig.rear().estimate.rejection.reset();
  connect(rig.estimates);
  EXPECT_EQ(rig.side().estimate.rejection,
            "verdict: too little overlap; its pose was found relative to rear, but not to the "
            "reference");
  EXPECT_EQ(rig.rear().failure,
            "global_alignment: no pose was found at which the clouds agree; its pose was found "
            "relative to side, but not to the reference");
}

TEST(SensorGraph, AddsTheUncertaintyOfTheSensorOnTheWay) {
  StreetRig sure = street_rig(), unsure = street_rig();
  unsure.side().estimate.covariance->matrix *= 1e4;
  connect(sure.estimates);
  connect(unsure.estimates);
  const Matrix6d change =
      unsure.rear().estimate.covariance->matrix - sure.rear().estimate.covariance->matrix;
  EXPECT_NEAR(change(0, 0), 1e-2, 1e-3);
  EXPECT_GT(change(5, 5), 0.9e-2);
}

TEST(SensorGraph, LeavesASensorRejectedThatNoOtherSees) {
  StreetRig rig = street_rig();
  Rng rng = test::test_rng();
  rig.rear().estimate.source = std::make_shared<const Cloud>(
      test::random_cloud(rng, 5000, 20.0), StreamKey(3).with("nothing in common"));
  connect(rig.estimates);
  EXPECT_EQ(rig.rear().estimate.rejection, "verdict: too little overlap");
  EXPECT_FALSE(rig.side().estimate.rejection);
}

TEST(SensorGraph, RejectsSensorsThatContradictEachOther) {
  StreetRig rig = street_rig();
  rig.rear().estimate.rejection.reset();
  rig.rear().estimate.T_target_source = rig.T_top_rear;
  connect(rig.estimates);
  EXPECT_FALSE(rig.side().estimate.rejection);
  EXPECT_FALSE(rig.rear().estimate.rejection);
  rig.rear().estimate.target = too_few_points();
  rig.rear().estimate.T_target_source.translation += Eigen::Vector3d(0.0, 3.0, 0.0);
  connect(rig.estimates);
  ASSERT_TRUE(rig.rear().estimate.rejection);
  EXPECT_NE(rig.rear().estimate.rejection->find("it contradicts side"), std::string::npos);
}

TEST(SensorGraph, DoesNotCompareCloudsFromWhichMotionWasRemovedAtAWrongPose) {
  StreetRig rig = street_rig();
  for (RigEstimate& one : rig.estimates) {
    one.estimate.extras.put(kMotion, Twist{Eigen::Vector3d::Zero(), {5.0, 0.0, 0.0}});
  }
  connect(rig.estimates);
  EXPECT_TRUE(rig.rear().estimate.rejection);
}

TEST(SensorGraph, FailsIfItsStepsEstimateNoCovariance) {
  StreetRig rig = street_rig();
  connect(rig.estimates, R"(, "pair": [{"step": "global_alignment"}])");
  EXPECT_EQ(rig.side().failure, "the steps of pair estimate no covariance");
}

TEST(SensorGraph, RefusesAFileOfVelocitiesInAPair) {
  EXPECT_THROW(test::build_stage("step", R"({"step": "sensor_graph", "pair": [{"step":
                                 "known_velocity", "file": "v.csv"}, {"step": "covariance"}]})"),
               InputError);
}

TEST(SensorGraph, IsTheSameTwice) {
  StreetRig first = street_rig(), again = street_rig();
  connect(first.estimates);
  connect(again.estimates);
  EXPECT_EQ(first.rear().estimate.T_target_source, again.rear().estimate.T_target_source);
}

}  // namespace
}  // namespace croon
