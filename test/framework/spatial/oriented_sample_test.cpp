#include "framework/spatial/normals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "framework/spatial/leaf_grid.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(OrientedSample, KeepsOnePointOfEachLeaf) {
  Rng rng = test::test_rng();
  const Points cloud = test::random_cloud(rng, 5000, 2.0);
  const LeafGrid grid(0.5);
  const auto leaf = [&](const Eigen::Vector3f& point) {
    const Eigen::Vector3i index = grid.leaf_of(point.cast<double>());
    return std::make_tuple(index.x(), index.y(), index.z());
  };
  std::set<std::tuple<int, int, int>> all, kept;
  for (const Eigen::Vector3f& point : cloud) all.insert(leaf(point));
  const OrientedPoints sample = oriented_sample(cloud, 0.5, 12);
  for (const Eigen::Vector3f& point : sample.points) EXPECT_TRUE(kept.insert(leaf(point)).second);
  EXPECT_EQ(kept, all);
}

TEST(OrientedSample, NormalsStandOnThePlaneUnderAnyPose) {
  Rng rng = test::test_rng(2);
  for (int i = 0; i < 50; ++i) {
    const RigidTransform T = test::random_pose(rng, 20.0);
    Points plane;
    for (int k = 0; k < 500; ++k) {
      const double x = rng.uniform(-5.0, 5.0);
      plane.push_back((T * Eigen::Vector3d(x, rng.uniform(-5.0, 5.0), 0.0)).cast<float>());
    }
    const OrientedPoints sample = oriented_sample(plane, 0.2, 15);
    ASSERT_EQ(sample.points.size(), sample.normals.size());
    EXPECT_GT(sample.points.size(), 300U);
    for (const Eigen::Vector3f& normal : sample.normals) {
      EXPECT_NEAR(std::abs(normal.cast<double>().dot(T.rotation.col(2))), 1.0, 1e-6);
    }
  }
}

TEST(OrientedSample, LeavesOutWhatHasNoNormal) {
  EXPECT_TRUE(oriented_sample({}, 0.1, 10).points.empty());
  EXPECT_TRUE(oriented_sample(Points(1000, {1, 2, 3}), 0.1, 10).points.empty());
  Points line;
  for (int i = 0; i < 100; ++i) line.emplace_back(0.5F * static_cast<float>(i), 0.0F, 1.0F);
  EXPECT_TRUE(oriented_sample(line, 0.1, 10).points.empty());
}

}  // namespace
}  // namespace croon
