#include "framework/spatial/kd_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "test/support/neighbours.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

bool is_nearer(const Neighbour& a, const Neighbour& b) {
  return std::tie(a.squared_distance_m2, a.index) < std::tie(b.squared_distance_m2, b.index);
}

/// All points of a cloud, nearest first, and of those at the same distance the least index first.
std::vector<Neighbour> by_distance(const Points& cloud, const Eigen::Vector3f& query) {
  std::vector<Neighbour> all;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    all.push_back({static_cast<int>(i), squared_distance_m2(cloud[i], query)});
  }
  std::sort(all.begin(), all.end(), is_nearer);
  return all;
}

/// Every kind of search against all points in order, to the last bit.
void expect_exact(const KdTree& tree, const Points& cloud, const Eigen::Vector3f& query) {
  const std::vector<Neighbour> truth = by_distance(cloud, query);
  test::expect_same(tree.nearest(query), truth[0]);
  for (const float reach_m : {0.2F, 0.8F, 4.0F}) {
    const float reach_m2 = reach_m * reach_m;
    const auto is_within = [&](std::size_t i) {
      return i < truth.size() && truth[i].squared_distance_m2 <= reach_m2;
    };
    const Neighbour nearest = tree.nearest(query, reach_m);
    ASSERT_EQ(static_cast<bool>(nearest), is_within(0));
    if (nearest) test::expect_same(nearest, truth[0]);
    const NearestAndRest both = tree.nearest_and_rest(query, reach_m);
    EXPECT_EQ(both.nearest.index, is_within(0) ? truth[0].index : -1);
    EXPECT_EQ(both.second, is_within(1) ? truth[1].index : -1);
    EXPECT_EQ(both.rest_beyond_m2, is_within(1) ? truth[1].squared_distance_m2 : reach_m2);
  }
  std::vector<Neighbour> neighbours;
  for (const int count : {1, 2, 12, 40, 200}) {
    for (const float guess_m : {0.0F, 0.01F, 0.7F, 1e30F}) {
      tree.nearest(query, count, neighbours, guess_m);
      ASSERT_EQ(neighbours.size(), std::min<std::size_t>(cloud.size(), count));
      std::sort(neighbours.begin(), neighbours.end(), is_nearer);
      for (std::size_t i = 0; i < neighbours.size(); ++i)
        test::expect_same(neighbours[i], truth[i]);
    }
  }
}

TEST(KdTree, AgreesWithLookingAtEveryPoint) {
  Rng rng = test::test_rng();
  // Less than a leaf, leaves that are full, one point more, and levels of two and of four children.
  for (const int size : {1, 2, 23, 24, 25, 48, 49, 96, 97, 700, 3000}) {
    const Points cloud = test::random_cloud(rng, size, 5.0);
    const KdTree tree(cloud);
    for (const Eigen::Vector3f& query : test::random_cloud(rng, 20, 7.0)) {
      expect_exact(tree, cloud, query);
    }
    expect_exact(tree, cloud, cloud.front());
    expect_exact(tree, cloud, {1e4F, -3.0F, 0.0F});
  }
}

TEST(KdTree, OfMovedPointsAgreesWithLookingAtEveryPoint) {
  Rng rng = test::test_rng();
  for (const int size : {1, 24, 25, 97, 700, 3000}) {
    const Points before = test::random_cloud(rng, size, 5.0);
    const KdTree tree(before);
    const RigidTransform T = test::random_pose(rng, 3.0);
    Points near;
    for (const Eigen::Vector3f& p : before) near.push_back((T * p.cast<double>()).cast<float>());
    // The second cloud has nothing to do with the first.
    for (const Points& moved : {near, test::random_cloud(rng, size, 5.0)}) {
      KdTree moved_tree(tree);
      moved_tree.move_to(moved);
      for (const Eigen::Vector3f& query : test::random_cloud(rng, 20, 7.0)) {
        expect_exact(moved_tree, moved, query);
        expect_exact(tree, before, query);
      }
    }
  }
}

TEST(KdTree, MovesTheSameNumberOfPointsOnly) {
  Rng rng = test::test_rng();
  KdTree tree(test::random_cloud(rng, 30, 1.0));
  EXPECT_THROW(tree.move_to(test::random_cloud(rng, 29, 1.0)), std::invalid_argument);
}

TEST(KdTree, OfEquallyNearPointsTheFirstIsNearest) {
  // A lattice, every point of which is there twice, and one place with more points than any search
  // keeps candidates.
  Points cloud(500, Eigen::Vector3f(1.0F, 1.0F, 0.0F));
  for (int twice = 0; twice < 2; ++twice) {
    for (int i = 0; i < 512; ++i) {
      cloud.emplace_back(static_cast<float>(i % 8), static_cast<float>(i / 8 % 8),
                         static_cast<float>(i / 64));
    }
  }
  const KdTree tree(cloud);
  for (int i = 0; i < 300; ++i) {
    expect_exact(tree, cloud,
                 {static_cast<float>(i % 17) * 0.5F, static_cast<float>(i % 13) * 0.5F,
                  static_cast<float>(i % 5) * 0.5F});
  }
}

TEST(KdTree, PointsMayBeFarApart) {
  const Points cloud = {{1e18F, 0.0F, 0.0F}, {-1e18F, 1e18F, 0.0F}, {0.0F, 0.0F, 1e-20F}};
  const KdTree tree(cloud);
  EXPECT_EQ(tree.nearest({0.9e18F, 0.0F, 0.0F}).index, 0);
  EXPECT_EQ(tree.nearest({0.0F, 0.0F, 0.0F}).index, 2);
  std::vector<Neighbour> neighbours;
  tree.nearest({0.0F, 0.0F, 0.0F}, 3, neighbours);
  EXPECT_EQ(neighbours.size(), 3U);
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
  EXPECT_EQ(neighbours.size(), 2U);
  KdTree(two).nearest({1, 0, 0}, 0, neighbours);
  EXPECT_TRUE(neighbours.empty());
  empty.nearest({1, 0, 0}, 40, neighbours);
  EXPECT_TRUE(neighbours.empty());
}

}  // namespace
}  // namespace croon
