#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/params/values.hpp"
#include "framework/stage/given_motions.hpp"
#include "framework/stage/motion.hpp"
#include "test/support/driven_scan.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

constexpr int kPoints = 400;

/// Surfaces at rest that a driving rig measured: each point at a time of its own.
struct DrivenScene {
  Points world;          ///< In the reference's frame half-way through its scan.
  RigidTransform truth;  ///< T_target_source.
  RigEstimate one;       ///< At the truth.
};

Twist some_velocity() { return {{0.02, -0.05, 0.4}, {17.0, -0.6, 0.2}}; }

/// What the sensor at `T_body_sensor` of a body with `velocity` measures of `world`, which is in
/// the sensor's frame at the time 0.05 s.
std::shared_ptr<const Cloud> driven_by(const Points& world, const Twist& velocity,
                                       const RigidTransform& T_body_sensor) {
  std::vector<double> times;
  for (std::size_t i = 0; i < world.size(); ++i) {
    times.push_back(0.1 * static_cast<double>(i) / static_cast<double>(world.size() - 1));
  }
  return std::make_shared<const Cloud>(
      test::driven_scan(world, times, 0.05, velocity, T_body_sensor), StreamKey(1));
}

/// A rig on a body with `velocity`, which has its reference at `T_body_reference`.
DrivenScene driven_scene(const Twist& velocity, const RigidTransform& T_body_reference = {}) {
  Rng rng = test::test_rng();
  DrivenScene scene;
  scene.world = test::random_cloud(rng, kPoints, 20.0);
  scene.truth = test::random_pose(rng, 2.0);
  scene.one = {"a", "top", "left", {}};
  Estimate& estimate = scene.one.estimate;
  estimate.T_target_source = scene.truth;
  estimate.target = driven_by(scene.world, velocity, T_body_reference);
  estimate.source = driven_by(transformed(scene.world, scene.truth.inverse()), velocity,
                              T_body_reference * scene.truth);
  return scene;
}

std::string members_of(const Twist& velocity) {
  const auto list = [](const Eigen::Vector3d& v) {
    return "[" + params::value_json(v.x()) + "," + params::value_json(v.y()) + "," +
           params::value_json(v.z()) + "]";
  };
  return R"("linear_mps": )" + list(velocity.linear_mps) + R"(, "angular_degps": )" +
         list(velocity.angular_radps * deg_from_rad(1.0));
}

params::Slot<Step> known_velocity(const std::string& members) {
  return test::stage<Step>(R"({"step": "known_velocity", )" + members + "}");
}

void adjust(const Step& step, RigEstimate& one) {
  Rng rng = test::test_rng();
  std::vector<RigEstimate> rig = {one};
  dynamic_cast<const RigStep&>(step).adjust(rig, rng);
  one = rig.front();
}

void expect_at_rest(const DrivenScene& scene) {
  ASSERT_EQ(scene.one.failure, "");
  const Estimate& estimate = scene.one.estimate;
  const Points in_sensor = transformed(scene.world, scene.truth.inverse());
  for (std::size_t i = 0; i < scene.world.size(); ++i) {
    EXPECT_LT((estimate.target->points()[i] - scene.world[i]).norm(), 2e-5F) << i;
    EXPECT_LT((estimate.source->points()[i] - in_sensor[i]).norm(), 2e-5F) << i;
  }
}

TEST(KnownVelocity, PutsWhatADrivingRigMeasuredWhereItWas) {
  DrivenScene scene = driven_scene(some_velocity());
  adjust(*known_velocity(members_of(some_velocity())), scene.one);
  expect_at_rest(scene);
  EXPECT_TRUE(scene.one.estimate.extras.get(kMotionCovariance).isZero());
}

TEST(KnownVelocity, TakesTheVelocityOfAnotherFrame) {
  const RigidTransform T_reference_ins = {rotation_from_rpy({0.0, 0.0, rad_from_deg(90.0)}),
                                          {-1.5, 0.4, -1.2}};
  DrivenScene scene = driven_scene(some_velocity(), T_reference_ins.inverse());
  adjust(*known_velocity(members_of(some_velocity()) +
                         R"(, "rotation_rpy_deg": [0, 0, 90], "translation_m": [-1.5, 0.4, -1.2],
                            "linear_std_mps": 0.1, "angular_std_degps": 2)"),
         scene.one);
  expect_at_rest(scene);
  const Extras& extras = scene.one.estimate.extras;
  const Twist expected = velocity_in(T_reference_ins, some_velocity());
  EXPECT_LT((vector_of(extras.get(kMotion)) - vector_of(expected)).norm(), 1e-9);
  // The lever arm of 1.5 m makes a turn about z a motion along y.
  const Matrix6d& covariance = extras.get(kMotionCovariance);
  const double turn = std::pow(rad_from_deg(2.0), 2);
  EXPECT_NEAR(covariance(2, 4), 1.5 * turn, 1e-12);
  EXPECT_NEAR(covariance(4, 4), 0.01 + (1.5 * 1.5 + 1.2 * 1.2) * turn, 1e-12);
}

TEST(KnownVelocity, IsThatOfTheSceneInTheFile) {
  const auto step =
      known_velocity(R"("file": "v.csv", "linear_std_mps": 1, "angular_std_degps": 1)");
  const auto& with_file = dynamic_cast<const GivenMotionStep&>(*step);
  EXPECT_EQ(with_file.file().name, "v.csv");
  const Vector6d stds = 0.1 * Vector6d::Ones();
  const auto given = with_file.with({{"a", {some_velocity(), stds}}, {"b", {{}, std::nullopt}}});
  DrivenScene scene = driven_scene(some_velocity());
  RigEstimate of_b = scene.one, of_c = scene.one;
  adjust(*given, scene.one);
  expect_at_rest(scene);
  EXPECT_TRUE(scene.one.estimate.extras.get(kMotionCovariance)
                  .isApprox(0.01 * Matrix6d::Identity(), 1e-12));
  of_b.scene = "b";
  adjust(*given, of_b);
  EXPECT_TRUE(vector_of(of_b.estimate.extras.get(kMotion)).isZero());
  EXPECT_NEAR(of_b.estimate.extras.get(kMotionCovariance)(5, 5), 1.0, 1e-12);
  of_c.scene = "c";
  adjust(*given, of_c);
  EXPECT_EQ(of_c.failure, "the file has no velocity for this scene");
}

TEST(KnownVelocity, OfAFileIsKnownInAnExperimentOnly) {
  DrivenScene scene = driven_scene({});
  adjust(*known_velocity(R"("file": "v.csv")"), scene.one);
  EXPECT_EQ(scene.one.failure, "only an experiment reads a file of velocities");
}

TEST(KnownVelocity, IsRemovedAfterAStepThatFoundNone) {
  DrivenScene scene = driven_scene(some_velocity());
  scene.one.estimate.extras.put(kMotion, Twist());
  scene.one.estimate.extras.put(kMotionCovariance, Matrix6d(Matrix6d::Zero()));
  adjust(*known_velocity(members_of(some_velocity())), scene.one);
  expect_at_rest(scene);
}

TEST(KnownVelocity, IsRemovedOnce) {
  const auto step = known_velocity(members_of(some_velocity()));
  DrivenScene scene = driven_scene(some_velocity());
  adjust(*step, scene.one);
  adjust(*step, scene.one);
  EXPECT_EQ(scene.one.failure, "an earlier step has already corrected the clouds for a velocity");
}

}  // namespace
}  // namespace croon
