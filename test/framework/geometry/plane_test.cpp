#include "framework/geometry/plane.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "framework/base/error.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

/// `count` points of the plane z = 0 with noise along z, then as many per cent of clutter as said.
Points plane_in_clutter(Rng& rng, int count, double noise_m, int clutter_percent) {
  Points cloud = test::random_cloud(rng, count * clutter_percent / 100, 10.0);
  for (int i = 0; i < count; ++i) {
    const double x = rng.uniform(-10.0, 10.0), y = rng.uniform(-10.0, 10.0);
    cloud.push_back(Eigen::Vector3d(x, y, noise_m * rng.normal()).cast<float>());
  }
  return cloud;
}

TEST(PlaneRansac, FindsAPlaneAmongFourTimesAsManyOtherPoints) {
  Rng rng = test::test_rng();
  const PlaneRansacOptions options;
  for (int i = 0; i < 50; ++i) {
    const RigidTransform T = test::random_pose(rng, 5.0);
    const Points cloud = transformed(plane_in_clutter(rng, 1000, 0.02, 400), T);
    const Eigen::Vector3d up = T.rotation.col(2);
    const Plane truth = {up, -up.dot(T.translation)};
    const Plane plane = plane_ransac(cloud, options, rng);
    const auto held = [&](const Plane& p) {
      return static_cast<double>(points_within(cloud, p, options.threshold_m).size());
    };
    EXPECT_GE(held(plane), 0.99 * held(truth));
    // 20 m of plane leave the slab where it is tilted by more than this.
    EXPECT_LT(std::asin(plane.normal.cross(up).norm()), 2.0 * options.threshold_m / 10.0);
  }
}

TEST(PlaneRansac, LocalOptimisationWinsPointsFromTheSameDraws) {
  Rng rng = test::test_rng(2);
  int won = 0, lost = 0;
  for (int i = 0; i < 50; ++i) {
    const Points cloud = plane_in_clutter(rng, 2000, 0.05, 100);
    PlaneRansacOptions options;
    options.threshold_m = 0.1;
    options.max_iterations = 20;
    const auto held = [&](int local_rounds) {
      options.local_rounds = local_rounds;
      Rng draws = test::test_rng(i);
      return points_within(cloud, plane_ransac(cloud, options, draws), options.threshold_m).size();
    };
    const std::size_t plain = held(0), optimised = held(4);
    won += optimised > plain ? 1 : 0;
    lost += optimised < plain ? 1 : 0;
  }
  EXPECT_GT(won, 40);
  EXPECT_LT(lost, 5);
}

TEST(PlaneRansac, NeedsThreePointsThatSpanAPlane) {
  Rng rng = test::test_rng(3);
  const Eigen::Vector3f a(1, 2, 3), b(4, 5, 6), c(1, 0, 0);
  EXPECT_THROW(plane_ransac({}, {}, rng), StageError);
  EXPECT_THROW(plane_ransac({a, b}, {}, rng), StageError);
  EXPECT_THROW(plane_ransac(Points(100, a), {}, rng), StageError);
  EXPECT_THROW(plane_ransac({a, b, a, b, a}, {}, rng), StageError);
  const Plane plane = plane_ransac({a, b, c}, {}, rng);
  for (const Eigen::Vector3f& point : {a, b, c}) {
    EXPECT_NEAR(plane.signed_distance(point.cast<double>()), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace croon
