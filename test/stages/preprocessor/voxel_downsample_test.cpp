#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "framework/registration/adaptive_voxels.hpp"
#include "framework/spatial/leaf_grid.hpp"
#include "framework/stage/preprocessor.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

params::Slot<Preprocessor> downsample(double leaf_size_m) {
  return test::stage<Preprocessor>(R"({"type": "voxel_downsample", "leaf_size_m": )" +
                                   std::to_string(leaf_size_m) + "}");
}

LeafKey leaf_of(const LeafGrid& grid, const Eigen::Vector3f& point) {
  return leaf_key(grid.leaf_of(point.cast<double>()));
}

TEST(VoxelDownsample, PutsTheMeanInPlaceOfEachLeaf) {
  Rng rng = test::test_rng();
  for (const double leaf_size_m : {0.25, 1.0, 7.5}) {
    const Points cloud = test::random_cloud(rng, 2000, 5.0);
    const LeafGrid grid(leaf_size_m);
    std::map<LeafKey, Points> leaves;
    std::vector<LeafKey> order;
    for (const Eigen::Vector3f& point : cloud) {
      Points& leaf = leaves[leaf_of(grid, point)];
      if (leaf.empty()) order.push_back(leaf_of(grid, point));
      leaf.push_back(point);
    }
    const Points thinned = downsample(leaf_size_m)->apply(cloud).points;
    ASSERT_EQ(thinned.size(), order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const Eigen::Vector3f& point : leaves[order[i]]) mean += point.cast<double>();
      mean /= static_cast<double>(leaves[order[i]].size());
      EXPECT_LT((thinned[i].cast<double>() - mean).norm(), 1e-6);
    }
  }
}

TEST(VoxelDownsample, LeavesSinglePointsAlone) {
  const Points cloud = {{5.5f, 0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}, {-0.1f, 0.1f, 0.1f}};
  EXPECT_EQ(downsample(1.0)->apply(cloud).points, cloud);
  EXPECT_TRUE(downsample(1.0)->apply({}).empty());
  EXPECT_EQ(downsample(1.0)->apply(Points(100, cloud[0])).points, (Points{cloud[0]}));
}

TEST(VoxelDownsample, SaysOfHowManyPointsEachIsTheMean) {
  Rng rng = test::test_rng();
  const Points cloud = test::random_cloud(rng, 2000, 5.0);
  const PointCloud once = downsample(0.5)->apply(cloud);
  const PointCloud twice = downsample(2.0)->apply(once);
  const PointCloud directly = downsample(2.0)->apply(cloud);
  ASSERT_EQ(twice.size(), directly.size());
  // Leaves of 2 m are unions of leaves of 0.5 m: thinning in two steps is thinning in one.
  EXPECT_EQ(channel_values(twice, kMeanOf), channel_values(directly, kMeanOf));
  for (std::size_t i = 0; i < twice.size(); ++i) {
    EXPECT_LT((twice.points[i] - directly.points[i]).norm(), 1e-5F);
  }
  const std::vector<double> counts = channel_values(directly, kMeanOf);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0.0), 2000.0);
}

TEST(VoxelDownsample, TakesTheMeanOfTheTimesInTheirType) {
  Rng rng = test::test_rng();
  PointCloud cloud = test::random_cloud(rng, 2000, 5.0);
  const Eigen::Vector3f velocity_mps(12.0F, -3.0F, 0.5F);
  std::vector<double> times_of_rays;
  std::vector<std::uint64_t> in_ns;
  constexpr std::uint64_t kNow_ns = 1'700'000'000'000'000'000;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto ns = static_cast<std::uint64_t>(rng.uniform(0.0, 1e8));
    in_ns.push_back(kNow_ns + ns);
    times_of_rays.push_back(1e-9 * static_cast<double>(ns));
  }
  cloud.channels = {make_channel(kTime, times_of_rays)};
  const PointCloud thinned = downsample(1.0)->apply(cloud);
  const std::vector<double> times = times_s(thinned);
  // Thinned and then moved is the mean of what is moved: the filter has no delay.
  std::map<LeafKey, std::pair<Eigen::Vector3d, int>> moved;
  const LeafGrid grid(1.0);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    auto& [sum, count] = moved[leaf_of(grid, cloud.points[i])];
    if (count++ == 0) sum.setZero();
    sum += (cloud.points[i] + static_cast<float>(times_of_rays[i]) * velocity_mps).cast<double>();
  }
  for (std::size_t i = 0; i < thinned.size(); ++i) {
    const auto& [sum, count] = moved.at(leaf_of(grid, thinned.points[i]));
    const Eigen::Vector3f after = thinned.points[i] + static_cast<float>(times[i]) * velocity_mps;
    EXPECT_LT((after.cast<double>() - sum / count).norm(), 1e-5);
  }
  cloud.channels = {make_channel(kTime, in_ns)};
  const PointCloud of_integers = downsample(1.0)->apply(cloud);
  EXPECT_TRUE(find_channel(of_integers, kTime)->type == scalar_type_of<std::uint64_t>());
  for (std::size_t i = 0; i < thinned.size(); ++i) {
    const double ns = find_channel(of_integers, kTime)->value(i) - static_cast<double>(kNow_ns);
    EXPECT_NEAR(1e-9 * ns, times[i], 1e-6);
  }
  // A mean of one point has its time to the last bit.
  EXPECT_EQ(find_channel(downsample(1e-3)->apply(cloud), kTime)->bytes, cloud.channels[0].bytes);
}

/// How far off `y_m` the planes are that two sensors with these clouds see, in the mean, metres.
double mean_plane_error_m(const PointCloud& cloud, double y_m) {
  const Cloud one(cloud, StreamKey(1)), other(cloud, StreamKey(2));
  RigState state;
  state.poses.resize(2);
  double error_m = 0.0;
  const std::vector<PlanePatch> patches =
      plane_patches({{0, &one}, {1, &other}}, state, 1, VoxelOptions{});
  for (const PlanePatch& patch : patches) {
    const PointSums& sums = patch.views.front().sums;
    error_m += sums.sum.y() / sums.weight - y_m;
  }
  EXPECT_GT(patches.size(), 4U);
  return error_m / static_cast<double>(patches.size());
}

TEST(VoxelDownsample, LeavesNoisyWallsInTheirPlaces) {
  Rng rng = test::test_rng();
  double worst_without_m = 0.0;
  for (const double y_m : {2.35, 2.37, 2.40, 2.42}) {
    Points wall;
    for (int i = 0; i < 40000; ++i) {
      const double x = rng.uniform(0.0, 4.0);
      const double y = y_m + 0.015 * rng.normal();
      const double z = rng.uniform(0.0, 2.0);
      wall.push_back(Eigen::Vector3d(x, y, z).cast<float>());
    }
    PointCloud thinned = downsample(0.1)->apply(wall);
    EXPECT_LT(std::abs(mean_plane_error_m(thinned, y_m)), 4e-4) << y_m;
    thinned.channels.clear();
    worst_without_m = std::max(worst_without_m, std::abs(mean_plane_error_m(thinned, y_m)));
  }
  EXPECT_GT(worst_without_m, 2e-3);
}

TEST(VoxelDownsample, GivesUpOnPointsBeyondItsLeaves) {
  EXPECT_EQ(downsample(0.1)->apply(Points{{1e7f, 0, 0}}).size(), 1u);
  EXPECT_THROW(downsample(0.1)->apply(Points{{1e9f, 0, 0}}), StageError);
  EXPECT_THROW(downsample(0.1)->apply(Points{{0, std::numeric_limits<float>::quiet_NaN(), 0}}),
               StageError);
}

}  // namespace
}  // namespace croon
