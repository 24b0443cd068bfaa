#include "framework/spatial/tracked_neighbours.hpp"

#include <gtest/gtest.h>

#include "test/support/neighbours.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(TrackedNeighbours, AnswersAsTheTreeWhateverThePointsDo) {
  Rng rng = test::test_rng();
  const Cloud target(test::random_street(rng, 4, 4000, 0.01), StreamKey(1));
  Points queries = test::random_street(rng, 4, 500, 0.05);
  TrackedNeighbours tracked(target, queries.size());
  // Steps of metres down to less than the rounding of a coordinate, and back.
  for (const double step_m : {3.0, 0.3, 0.03, 0.003, 0.0003, 1e-7, 0.0, 0.01, 1.0}) {
    for (const float max_distance_m : {1.0F, 0.3F, 0.05F, 2.0F}) {
      for (std::size_t i = 0; i < queries.size(); ++i) {
        queries[i] += (step_m * test::random_pose(rng, 1.0).rotation.col(0)).cast<float>();
        test::expect_same(tracked.nearest(static_cast<int>(i), queries[i], max_distance_m),
                          target.kd_tree().nearest(queries[i], max_distance_m));
      }
    }
  }
}

TEST(TrackedNeighbours, TiesAndBoundsAreThoseOfTheTree) {
  // Points in pairs at one place, and queries half-way between two pairs.
  Points points;
  for (int i = 0; i < 50; ++i) {
    points.insert(points.end(), 2, Eigen::Vector3f(static_cast<float>(i), 0.0F, 0.0F));
  }
  const Cloud target(points, StreamKey(1));
  TrackedNeighbours tracked(target, 1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f query(static_cast<float>(i) * 0.25F, 0.0F, 0.0F);
    for (const float max_distance_m : {0.25F, 0.5F, 0.4999F, 10.0F}) {
      test::expect_same(tracked.nearest(0, query, max_distance_m),
                        target.kd_tree().nearest(query, max_distance_m));
    }
  }
}

TEST(TrackedNeighbours, AnEmptyCloudHasNone) {
  const Cloud target(Points{}, StreamKey(1));
  TrackedNeighbours tracked(target, 1);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(tracked.nearest(0, {0.0F, 0.0F, 0.0F}, 1.0F));
}

}  // namespace
}  // namespace croon
