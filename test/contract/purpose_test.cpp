// Every stage does what its kind is for, on a street whose geometry is known. The bounds are loose:
// they separate stages that work from stages that do not, not good ones from better ones.
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/stage/ground_extractor.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/volume_scorer.hpp"
#include "framework/stage/yaw_search.hpp"
#include "test/contract/every_stage.hpp"
#include "test/contract/outcome.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon::test {
namespace {

constexpr double kGroundHeight_m = -2.0;  // Of random_street.

class ContractOfPreprocessors : public EveryStage {};

TEST_P(ContractOfPreprocessors, MakeNoPointsOutsideTheCloud) {
  Rng rng = test_rng(31);
  const Points cloud = random_street(rng, 4, 3000, 0.01);
  const Points after = stage<Preprocessor>(minimal_json(entry()))->apply(measured(cloud)).points;
  EXPECT_LE(after.size(), cloud.size());
  EXPECT_GT(after.size(), 0U);
  Eigen::Vector3f low = cloud.front();
  Eigen::Vector3f high = cloud.front();
  for (const Eigen::Vector3f& point : cloud) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  for (const Eigen::Vector3f& point : after) {
    EXPECT_TRUE((point.array() >= low.array() && point.array() <= high.array()).all());
  }
}

TEST_P(ContractOfPreprocessors, KeepTheChannelsAsLongAsThePoints) {
  Rng rng = test_rng(32);
  for (const int count : {0, 1, 3000}) {
    const PointCloud cloud = measured(random_street(rng, 4, count, 0.01));
    const PointCloud after = stage<Preprocessor>(minimal_json(entry()))->apply(cloud);
    for (const Channel& channel : cloud.channels) {
      const Channel* const kept = find_channel(after, channel.name);
      ASSERT_NE(kept, nullptr) << channel.name;
      EXPECT_TRUE(kept->type == channel.type);
      EXPECT_EQ(kept->bytes.size(), after.size() * channel.bytes_per_point()) << channel.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfPreprocessors,
                         testing::ValuesIn(every_stage_of("preprocessor")), stage_case_name);

class ContractOfGroundExtractors : public EveryStage {};

TEST_P(ContractOfGroundExtractors, FindTheRoadUnderATiltedSensor) {
  const auto extractor = stage<GroundExtractor>(minimal_json(entry()));
  for (std::uint64_t i = 0; i < 3; ++i) {
    Rng rng = test_rng(41 + i);
    const Points level = random_street(rng, 4, 8000, 0.01);
    // The sensor stays at least 1 m above the road: below it, no plane is a ground.
    const RigidTransform T_tilted_level = random_pose(rng, 0.5);
    const Points cloud = transformed(level, T_tilted_level);
    const Ground ground = extractor->extract(cloud, rng);
    ASSERT_EQ(ground.is_ground.size(), cloud.size());
    const Eigen::Vector3d up = T_tilted_level.rotation.col(2);
    EXPECT_GT(std::abs(ground.plane.normal.dot(up)), std::cos(rad_from_deg(2.0)));
    const Eigen::Vector3d on_road = T_tilted_level * Eigen::Vector3d(0, 0, kGroundHeight_m);
    EXPECT_LT(std::abs(ground.plane.signed_distance(on_road)), 0.2);
    int road = 0;
    int found = 0;
    for (std::size_t k = 0; k < level.size(); ++k) {
      if (std::abs(level[k].z() - kGroundHeight_m) > 0.05) continue;
      ++road;
      found += ground.is_ground[k];
    }
    EXPECT_GT(found, road * 8 / 10);
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfGroundExtractors,
                         testing::ValuesIn(every_stage_of("ground_extractor")), stage_case_name);

class ContractOfIcps : public EveryStage {};

/// 1.5 degrees and 10 cm off per axis, the pose ends within 0.5 degrees and 5 cm, and nearer than
/// it began.
TEST_P(ContractOfIcps, ConvergeFromNearTheTruth) {
  const auto icp = stage<Icp>(minimal_json(entry()));
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Rng rng = test_rng(50 + seed);
    const RigidTransform truth = random_pose(rng, 2.0);
    const StreetPair pair = street_pair(rng, seed, truth, 8000, 4000, 0.005);
    const CloudPair clouds = cloud_pair(pair.target, pair.source);
    const RigidTransform start = pose_near(rng, truth, 1.5, 0.1);
    const Registration result = icp->align(*clouds.target, *clouds.source, start);
    const PoseError error = pose_error(result.T_target_source, truth);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.5) << "seed " << seed;
    EXPECT_LT(error.translation_m, 0.05) << "seed " << seed;
    EXPECT_LT(error.translation_m, pose_error(start, truth).translation_m) << "seed " << seed;
    EXPECT_GT(result.inlier_ratio, 0.5);
    EXPECT_TRUE(result.information.isApprox(result.information.transpose(), 1e-9));
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfIcps, testing::ValuesIn(every_stage_of("icp")),
                         stage_case_name);

class ContractOfVolumeScorers : public EveryStage {};

TEST_P(ContractOfVolumeScorers, AlignedCloudsOccupyTheLeast) {
  const auto scorer = stage<VolumeScorer>(minimal_json(entry()));
  Rng rng = test_rng(61);
  const Points cloud = random_street(rng, 4, 3000, 0.0);
  const CloudPair clouds = cloud_pair(cloud, cloud);
  const VolumeFunction volume = scorer->bind(clouds.target, clouds.source);
  const double aligned_m3 = volume({}).m3;
  EXPECT_GT(aligned_m3, 0.0);
  for (int i = 0; i < 20; ++i) {
    EXPECT_GT(volume(pose_near(rng, {}, 10.0, 0.5)).m3, aligned_m3);
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfVolumeScorers,
                         testing::ValuesIn(every_stage_of("volume_scorer")), stage_case_name);

class ContractOfYawSearches : public EveryStage {};

TEST_P(ContractOfYawSearches, FindTheOnlyLeast) {
  const auto search = stage<YawSearch>(minimal_json(entry()));
  Rng rng = test_rng(71);
  for (int i = 0; i < 20; ++i) {
    const double least_rad = rad_from_deg(rng.uniform(-40.0, 40.0));
    const auto cost = [&](double yaw_rad) { return 1.0 - std::cos(yaw_rad - least_rad); };
    const YawMinimum minimum = search->minimise(cost);
    EXPECT_NEAR(minimum.yaw_rad, least_rad, rad_from_deg(1.0));
    EXPECT_EQ(minimum.cost, cost(minimum.yaw_rad));
    EXPECT_GT(minimum.evaluations, 0);
  }
}

TEST_P(ContractOfYawSearches, ACostThatStopsEarlyChangesNothing) {
  const auto search = stage<YawSearch>(minimal_json(entry()));
  Rng rng = test_rng(72);
  for (int i = 0; i < 20; ++i) {
    const double least_rad = rad_from_deg(rng.uniform(-40.0, 40.0));
    const auto cost = [&](double yaw_rad) {
      return 1.5 - std::cos(yaw_rad - least_rad) - 0.4 * std::cos(5.0 * yaw_rad);
    };
    const auto below = [&](double yaw_rad, double enough) {
      const double whole = cost(yaw_rad);
      return whole < enough ? whole : enough;
    };
    const YawMinimum expected = search->minimise(cost);
    const YawMinimum found = search->minimise({cost, below});
    EXPECT_EQ(found.yaw_rad, expected.yaw_rad);
    EXPECT_EQ(found.cost, expected.cost);
    EXPECT_EQ(found.evaluations, expected.evaluations);
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfYawSearches,
                         testing::ValuesIn(every_stage_of("yaw_search")), stage_case_name);

}  // namespace
}  // namespace croon::test
