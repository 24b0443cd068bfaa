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
  const ConsistencyGraph graph(pairs, {4.0, 2.0});
  for (int seed = 0; seed < graph.size(); ++seed) {
    const std::vector<int> clique = graph.clique(seed);
    EXPECT_EQ(clique.front(), seed);
    for (int other = 0; other < graph.size(); ++other) {
      const bool is_member = std::find(clique.begin(), clique.end(), other) != clique.end();
      const bool agrees = std::all_of(clique.begin(), clique.end(), [&](int member) {
        return member == other || graph.are_consistent(member, other);
      });
      EXPECT_EQ(agrees, is_member);
    }
  }
}

TEST(ConsistencyGraph, CoreNumbersAreTheLargestOfSubgraphs) {
  Rng rng = test::test_rng(4);
  const OrientedPairs pairs = pairs_of(rng, test::random_pose(rng, 10.0), 15, 150);
  const ConsistencyGraph graph(pairs, {3.0, 2.0});
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
          neighbours += remains[j] && graph.are_consistent(i, j) ? 1 : 0;
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
