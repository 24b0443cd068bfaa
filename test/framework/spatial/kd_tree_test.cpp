#include "framework/spatial/kd_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

/// Squared distances to all points, in order of size.
std::vector<float> sorted_squared_distances(const Points& cloud, const Eigen::Vector3f& query) {
  std::vector<float> distances;
  for (const Eigen::Vector3f& point : cloud) distances.push_back((point - query).squaredNorm());
  std::sort(distances.begin(), distances.end());
  return distances;
}

TEST(KdTree, AgreesWithLookingAtEveryPoint) {
  Rng rng = test::test_rng();
  const Points cloud = test::random_cloud(rng, 700, 5.0);
  const KdTree tree(cloud);
  std::vector<Neighbour> neighbours;
  for (const Eigen::Vector3f& query : test::random_cloud(rng, 200, 7.0)) {
    const std::vector<float> truth = sorted_squared_distances(cloud, query);
    const Neighbour nearest = tree.nearest(query);
    ASSERT_TRUE(nearest);
    EXPECT_NEAR(nearest.squared_distance_m2, truth[0], 1e-5F * truth[0]);
    EXPECT_FLOAT_EQ((cloud[nearest.index] - query).squaredNorm(), nearest.squared_distance_m2);
    tree.nearest(query, 12, neighbours);
    ASSERT_EQ(neighbours.size(), 12u);
    for (int i = 0; i < 12; ++i) {
      EXPECT_NEAR(neighbours[i].squared_distance_m2, truth[i], 1e-5F * truth[i]);
    }
    const float bound = 0.8F;
    EXPECT_EQ(static_cast<bool>(tree.nearest(query, bound)), truth[0] <= bound * bound);
  }
}

TEST(KdTree, CountsTheBoundItselfAsWithin) {
  const Points cloud = {{1.0F, 0.0F, 0.0F}};
  const KdTree tree(cloud);
  EXPECT_TRUE(tree.nearest({0.0F, 0.0F, 0.0F}, 1.0F));
  EXPECT_FALSE(tree.nearest({0.0F, 0.0F, 0.0F}, 0.999F));
}

TEST(KdTree, SmallAndEmptyCloudsAnswer) {
  const Points none;
  const KdTree empty(none);
  EXPECT_FALSE(empty.nearest({0, 0, 0}));
  const Points two = {{0, 0, 0}, {0, 0, 0}};
  std::vector<Neighbour> neighbours;
  KdTree(two).nearest({1, 0, 0}, 40, neighbours);
  EXPECT_EQ(neighbours.size(), 2u);
}

}  // namespace
}  // namespace croon
