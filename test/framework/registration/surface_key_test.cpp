#include "framework/registration/surface_key.hpp"

#include <gtest/gtest.h>

#include <set>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(SurfaceKey, IsTheSameForOppositeNormals) {
  Rng rng = test::test_rng();
  std::set<int> bins;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d point = test::random_pose(rng, 1.0).translation;
    const Eigen::Vector3d normal = test::random_pose(rng, 1.0).rotation.col(0);
    EXPECT_EQ(surface_key(point, normal, 3.0), surface_key(point, -normal, 3.0));
    bins.insert(direction_bin(normal));
  }
  EXPECT_EQ(static_cast<int>(bins.size()), kDirectionBins);
  EXPECT_EQ(*bins.begin(), 0);
  EXPECT_EQ(*bins.rbegin(), kDirectionBins - 1);
}

TEST(SurfaceKey, HoldsTheCubeOfThePoint) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_EQ(surface_key({0.1, 2.9, -0.1}, up, 3.0).first, (LeafKey{0, 0, -1}));
  EXPECT_EQ(surface_key({3.0, -3.0, 5.9}, up, 3.0).first, (LeafKey{1, -1, 1}));
  EXPECT_NE(surface_key({0.0, 0.0, 0.0}, up, 3.0),
            surface_key({0.0, 0.0, 0.0}, Eigen::Vector3d::UnitX(), 3.0));
}

TEST(SurfaceKey, TakesStrayPointsInTheLastCube) {
  const SurfaceKey far = surface_key({1e30, -1e30, 0.0}, Eigen::Vector3d::UnitZ(), 3.0);
  EXPECT_EQ(far.first, (LeafKey{LeafGrid::kMaxIndex, -LeafGrid::kMaxIndex, 0}));
}

}  // namespace
}  // namespace croon
