#include "framework/spatial/nearest_distance_cost.hpp"

#include <gtest/gtest.h>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(NearestDistanceCost, IsTheMeanOfTheCutSquaredDistances) {
  Rng rng = test::test_rng();
  const auto target =
      std::make_shared<const Cloud>(test::random_cloud(rng, 300, 3.0), StreamKey(1));
  const Cloud source(test::random_cloud(rng, 200, 4.0), StreamKey(2));
  const RigidTransform T = test::random_pose(rng, 1.0);
  const double farthest_m = 1.2;
  double sum = 0.0;
  for (const Eigen::Vector3f& point : transformed(source.points(), T)) {
    double least = farthest_m * farthest_m;
    for (const Eigen::Vector3f& other : target->points()) {
      least = std::min<double>(least, (point - other).squaredNorm());
    }
    sum += least;
  }
  EXPECT_NEAR(NearestDistanceCost(target, source, 1000, farthest_m)(T), sum / 200.0, 1e-5);
}

TEST(NearestDistanceCost, IsZeroWhereTheCloudsCoincide) {
  Rng rng = test::test_rng();
  const Points points = test::random_cloud(rng, 300, 3.0);
  const RigidTransform T = test::random_pose(rng, 2.0);
  const auto target = std::make_shared<const Cloud>(transformed(points, T), StreamKey(1));
  const Cloud source(points, StreamKey(2));
  for (const int max_points : {10, 100, 1000}) {
    EXPECT_LT(NearestDistanceCost(target, source, max_points, 5.0)(T), 1e-10);
    EXPECT_GT(NearestDistanceCost(target, source, max_points, 5.0)(RigidTransform{}), 0.1);
  }
}

}  // namespace
}  // namespace croon
