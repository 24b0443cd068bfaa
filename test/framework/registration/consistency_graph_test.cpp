#include "framework/registration/consistency_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "framework/geometry/rigid_transform.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

Eigen::Vector3f direction(Rng& rng) {
  return Eigen::Vector3d{rng.normal(), rng.normal(), rng.normal()}.normalized().cast<float>();
}

/// `right` correspondences of the pose T_target_source, then `wrong` ones at random.
OrientedPairs pairs_of(Rng& rng, const RigidTransform& T, int right, int wrong) {
  OrientedPairs pairs;
  pairs.source = test::random_cloud(rng, right + wrong, 20.0);
  pairs.target = transformed(pairs.source, T);
  for (int i = 0; i < right + wrong; ++i) {
    const Eigen::Vector3f normal = direction(rng);
    pairs.source_normals.push_back(normal);
    pairs.target_normals.push_back((T.rotation * normal.cast<double>()).cast<float>());
    if (i < right) continue;
    pairs.target[i] = test::random_cloud(rng, 1, 20.0).front();
    pairs.target_normals[i] = direction(rng);
  }
  return pairs;
}

/// Which two correspondences agree: those that are a clique of two in a graph of their own.
std::vector<std::vector<bool>> agreement(const OrientedPairs& all,
                                         const ConsistencyOptions& options) {
  std::vector<std::vector<bool>> agree(all.size(), std::vector<bool>(all.size(), false));
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const OrientedPairs two = {{all.target[i], all.target[j]},
                                 {all.target_normals[i], all.target_normals[j]},
                                 {all.source[i], all.source[j]},
                                 {all.source_normals[i], all.source_normals[j]}};
      agree[i][j] = agree[j][i] = ConsistencyGraph(two, options).clique(0).size() == 2;
    }
  }
  return agree;
}

TEST(ConsistencyGraph, RightCorrespondencesAllAgree) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 10; ++i) {
    const OrientedPairs pairs = pairs_of(rng, test::random_pose(rng, 10.0), 40, 0);
    const ConsistencyGraph graph(pairs, {0.01, 0.01});
    EXPECT_EQ(graph.clique(i).size(), 40U);
    for (const int core : graph.core_numbers()) EXPECT_EQ(core, 39);
  }
}

TEST(ConsistencyGraph, FindsTheRightOnesAmongManyMoreWrongOnes) {
  Rng rng = test::test_rng(2);
  for (int i = 0; i < 10; ++i) {
    const OrientedPairs pairs = pairs_of(rng, test::random_pose(rng, 10.0), 20, 380);
    const ConsistencyGraph graph(pairs, {0.4, 0.35});
    const std::vector<int> cores = graph.core_numbers();
    const auto densest = std::max_element(cores.begin(), cores.end());
    std::vector<int> clique = graph.clique(static_cast<int>(densest - cores.begin()));
    EXPECT_GE(clique.size(), 20U);
    std::sort(clique.begin(), clique.end());
    for (int k = 0; k < 20; ++k) EXPECT_EQ(clique[k], k);
  }
}

TEST(ConsistencyGraph, ACliqueAgreesAndNoOtherCanJoinIt) {
  Rng rng = test::test_rng(3);
  const OrientedPairs pairs = pairs_of(rng, test::random_pose(rng, 10.0), 10, 120);
  const ConsistencyOptions options = {4.0, 2.0};
  const ConsistencyGraph graph(pairs, options);
  const std::vector<std::vector<bool>> agree = agreement(pairs, options);
  for (int seed = 0; seed < graph.size(); ++seed) {
    const std::vector<int> clique = graph.clique(seed);
    EXPECT_EQ(clique.front(), seed);
    for (int other = 0; other < graph.size(); ++other) {
      const bool is_member = std::find(clique.begin(), clique.end(), other) != clique.end();
      const bool agrees = std::all_of(clique.begin(), clique.end(), [&](int member) {
        return member == other || agree[member][other];
      });
      EXPECT_EQ(agrees, is_member);
    }
  }
}

TEST(ConsistencyGraph, CoreNumbersAreTheLargestOfSubgraphs) {
  Rng rng = test::test_rng(4);
  const OrientedPairs pairs = pairs_of(rng, test::random_pose(rng, 10.0), 15, 150);
  const ConsistencyOptions options = {3.0, 2.0};
  const ConsistencyGraph graph(pairs, options);
  const std::vector<std::vector<bool>> agree = agreement(pairs, options);
  const std::vector<int> cores = graph.core_numbers();
  const int most = *std::max_element(cores.begin(), cores.end());
  for (int k = 0; k <= most + 1; ++k) {
    // Vertices with less than k neighbours are taken away until none is left.
    std::vector<bool> remains(cores.size(), true);
    for (bool changed = true; changed;) {
      changed = false;
      for (int i = 0; i < graph.size(); ++i) {
        if (!remains[i]) continue;
        int neighbours = 0;
        for (int j = 0; j < graph.size(); ++j) {
          neighbours += remains[j] && agree[i][j] ? 1 : 0;
        }
        if (neighbours >= k) continue;
        remains[i] = false;
        changed = true;
      }
    }
    for (int i = 0; i < graph.size(); ++i) EXPECT_EQ(remains[i], cores[i] >= k) << k;
  }
}

TEST(ConsistencyGraph, MayBeEmpty) {
  const ConsistencyGraph graph({}, {});
  EXPECT_EQ(graph.size(), 0);
  EXPECT_TRUE(graph.core_numbers().empty());
}

}  // namespace
}  // namespace croon
