#include "framework/spatial/leaf_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/base/error.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(LeafGrid, ALeafHoldsItsPoint) {
  Rng rng = test::test_rng();
  for (const double leaf_size_m : {0.001, 0.02, 0.05, 0.3, 10.0}) {
    const LeafGrid grid(leaf_size_m);
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d point = test::random_pose(rng, 100.0).translation;
      const Eigen::Vector3d inside = point - leaf_size_m * grid.leaf_of(point).cast<double>();
      EXPECT_GE(inside.minCoeff(), -1e-12);
      EXPECT_LE(inside.maxCoeff(), leaf_size_m + 1e-12);
    }
  }
}

TEST(LeafGrid, ABorderBelongsToTheLeafAboveIt) {
  const LeafGrid grid(0.25);
  for (int index = -1000; index <= 1000; ++index) {
    const double border_m = 0.25 * index;
    const double below_m = std::nextafter(border_m, -1e9);
    EXPECT_EQ(grid.leaf_of({border_m, 0.0, below_m}), Eigen::Vector3i(index, 0, index - 1));
  }
  EXPECT_EQ(grid.leaf_of({-0.0, 1e-300, -1e-300}), Eigen::Vector3i(0, 0, -1));
}

TEST(LeafGrid, RefusesWhatNoIndexReaches) {
  const LeafGrid grid(0.5);
  const double end_m = 0.5 * LeafGrid::kMaxIndex;
  EXPECT_EQ(grid.leaf_of({end_m, -end_m, 0.0}),
            Eigen::Vector3i(LeafGrid::kMaxIndex, -LeafGrid::kMaxIndex, 0));
  EXPECT_THROW(grid.leaf_of({end_m + 0.5, 0.0, 0.0}), StageError);
  EXPECT_THROW(grid.leaf_of({0.0, -end_m - 0.5, 0.0}), StageError);
  EXPECT_THROW(LeafGrid(0.001).leaf_of({0.0, 0.0, 1e9}), StageError);
  for (const double value : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), -1e300}) {
    EXPECT_THROW(grid.leaf_of({0.0, value, 0.0}), StageError);
  }
}

}  // namespace
}  // namespace croon
