#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/stage/step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

std::shared_ptr<const Cloud> shared_cloud(Points points, std::uint64_t seed) {
  return std::make_shared<const Cloud>(std::move(points), StreamKey(seed).with("cloud"));
}

/// Two sensors in one street: the reference, whose frame is the street's (ground at z = -2), and
/// another.
struct Rig {
  RigidTransform T_target_source;
  Estimate estimate;
};

Rig random_rig(Rng& rng, std::uint64_t scene_seed) {
  Rig rig;
  rig.T_target_source = test::random_pose(rng, 1.0);
  Points target = test::random_street(rng, scene_seed, 12000, 0.01);
  const Points street = test::random_street(rng, scene_seed, 9000, 0.01);
  rig.estimate.target = shared_cloud(std::move(target), 2 * scene_seed);
  rig.estimate.source =
      shared_cloud(transformed(street, rig.T_target_source.inverse()), 2 * scene_seed + 1);
  return rig;
}

/// Up in the source's frame.
Eigen::Vector3d up_in_source(const Rig& rig) {
  return rig.T_target_source.rotation.transpose() * Eigen::Vector3d::UnitZ();
}

TEST(GroundAlignment, SolvesRollPitchAndHeightFromAnyStart) {
  Rng rng = test::test_rng();
  const auto step = test::stage<Step>(R"({"step": "ground_alignment"})");
  for (int i = 0; i < 30; ++i) {
    const Rig rig = random_rig(rng, i);
    for (int trial = 0; trial < 5; ++trial) {
      Estimate start = rig.estimate;
      start.T_target_source = test::random_pose(rng, 1.0);
      const RigidTransform T = step->advance(start, rng).T_target_source;
      const Eigen::Vector3d up = T.rotation * up_in_source(rig);
      EXPECT_GT(up.z(), 0.0) << "upside down";
      EXPECT_LT(deg_from_rad(std::asin(up.head<2>().norm())), 0.05);
      // A point of the ground lands on the ground.
      const Eigen::Vector3d foot = rig.T_target_source.inverse() * Eigen::Vector3d(0, 0, -2.0);
      EXPECT_NEAR((T * foot).z(), -2.0, 0.005);
    }
  }
}

TEST(GroundAlignment, TurnsAStartThatIsUpsideDown) {
  Rng rng = test::test_rng(2);
  const auto step = test::stage<Step>(R"({"step": "ground_alignment"})");
  for (int i = 0; i < 20; ++i) {
    const Rig rig = random_rig(rng, 100 + i);
    for (const Dof dof : {Dof::roll, Dof::pitch}) {
      Vector6d offset = Vector6d::Zero();
      offset(static_cast<Eigen::Index>(dof)) = kPi;
      Estimate start = rig.estimate;
      start.T_target_source = moved(rig.T_target_source, offset);
      const RigidTransform T = step->advance(start, rng).T_target_source;
      EXPECT_GT((T.rotation * up_in_source(rig)).z(), 0.999999);
    }
  }
}

TEST(GroundAlignment, KnowsTheGroundAndWhatStandsOnIt) {
  Rng rng = test::test_rng(3);
  const auto step = test::stage<Step>(R"({"step": "ground_alignment"})");
  const Rig rig = random_rig(rng, 7);
  const Estimate estimate = step->advance(rig.estimate, rng);
  EXPECT_LT((estimate.up() - Eigen::Vector3d::UnitZ()).norm(), 1e-3);
  EXPECT_LT((estimate.source_ground->plane.normal - up_in_source(rig)).norm(), 1e-3);
  for (const auto& [cloud, ground] : {std::pair(estimate.target, estimate.target_ground),
                                      std::pair(estimate.source, estimate.source_ground)}) {
    EXPECT_GT(ground->non_ground->points().size(), cloud->points().size() / 4);
    EXPECT_LT(ground->non_ground->points().size(), cloud->points().size() * 3 / 4);
    for (const Eigen::Vector3f& point : ground->non_ground->points()) {
      EXPECT_GT(ground->plane.signed_distance(point.cast<double>()), 0.15);
    }
  }
}

TEST(GroundAlignment, RefusesAnEmptyCloud) {
  Rng rng = test::test_rng(4);
  const auto step = test::stage<Step>(R"({"step": "ground_alignment"})");
  Rig rig = random_rig(rng, 8);
  rig.estimate.source = shared_cloud({}, 1);
  EXPECT_THROW(step->advance(rig.estimate, rng), StageError);
}

TEST(GroundAlignment, PointsOffTheGroundKeepTheirChannels) {
  Rng rng = test::test_rng();
  Rig rig = random_rig(rng, 3);
  const PointCloud cloud = test::measured(rig.estimate.source->points());
  rig.estimate.source = std::make_shared<const Cloud>(cloud, StreamKey(3));
  const auto step = test::stage<Step>(R"({"step": "ground_alignment"})");
  const Estimate after = step->advance(rig.estimate, rng);
  const PointCloud& kept = after.source_ground->non_ground->with_channels();
  ASSERT_GT(kept.size(), 1000U);
  std::size_t index = 0;
  for (std::size_t i = 0; i < kept.size(); ++i, ++index) {
    while (cloud.points.at(index) != kept.points[i]) ++index;
    for (const Channel& channel : cloud.channels) {
      ASSERT_EQ(find_channel(kept, channel.name)->value(i), channel.value(index)) << channel.name;
    }
  }
}

}  // namespace
}  // namespace croon
