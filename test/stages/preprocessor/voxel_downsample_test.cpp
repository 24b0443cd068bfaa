#include <gtest/gtest.h>

#include <limits>
#include <map>

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

TEST(VoxelDownsample, GivesUpOnPointsBeyondItsLeaves) {
  EXPECT_EQ(downsample(0.1)->apply(Points{{1e7f, 0, 0}}).size(), 1u);
  EXPECT_THROW(downsample(0.1)->apply(Points{{1e9f, 0, 0}}), StageError);
  EXPECT_THROW(downsample(0.1)->apply(Points{{0, std::numeric_limits<float>::quiet_NaN(), 0}}),
               StageError);
}

}  // namespace
}  // namespace croon
