#include "framework/stage/ground_from_planes.hpp"

#include <gtest/gtest.h>

#include <string>

#include "framework/base/error.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

/// `count` points of the plane z = `height_m`, 20 m across.
void add_level(Points& cloud, Rng& rng, int count, double height_m) {
  for (int i = 0; i < count; ++i) {
    const double x = rng.uniform(-10.0, 10.0);
    cloud.push_back(Eigen::Vector3d(x, rng.uniform(-10.0, 10.0), height_m).cast<float>());
  }
}

Plane level(double height_m) { return {Eigen::Vector3d::UnitZ(), -height_m}; }

TEST(GroundFromPlanes, TakesTheFullestPlane) {
  Rng rng = test::test_rng();
  Points cloud;
  add_level(cloud, rng, 400, 3.0);
  add_level(cloud, rng, 600, -1.0);
  add_level(cloud, rng, 500, 1.0);
  const Ground ground = ground_from_planes(cloud, {level(3.0), level(-1.1), level(1.0)}, {}, rng);
  EXPECT_NEAR(ground.plane.signed_distance(Eigen::Vector3d(0, 0, -1.0)), 0.0, 1e-6);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(ground.is_ground[i], i >= 400 && i < 1000 ? 1 : 0);
  }
}

TEST(GroundFromPlanes, AKerbInTheSlabDoesNotLiftTheGround) {
  Rng rng = test::test_rng(2);
  Points cloud;
  add_level(cloud, rng, 2000, 0.0);
  for (int i = 0; i < 600; ++i) {
    const double x = rng.uniform(-10.0, 10.0);
    cloud.push_back(Eigen::Vector3d(x, rng.uniform(7.0, 10.0), 0.15).cast<float>());
  }
  const Eigen::Vector3d tilted = Eigen::Vector3d(0.002, -0.004, 1.0).normalized();
  const auto error_m = [&](double refit_threshold_m) {
    const Ground ground =
        ground_from_planes(cloud, {Plane{tilted, -0.03}}, {0.2, refit_threshold_m, 0.05}, rng);
    return std::abs(ground.plane.signed_distance(Eigen::Vector3d(0, -10.0, 0)));
  };
  EXPECT_LT(error_m(0.05), 1e-6);
  EXPECT_GT(error_m(0.2), 0.01);  // What the narrower slab is for.
}

TEST(GroundFromPlanes, SaysHowFewPointsTheLargestPlaneHolds) {
  Rng rng = test::test_rng(3);
  Points cloud = test::random_cloud(rng, 900, 50.0);
  add_level(cloud, rng, 100, 60.0);
  try {
    ground_from_planes(cloud, {level(60.0)}, {0.2, 0.05, 0.25}, rng);
    FAIL() << "a tenth of the points passed for a quarter";
  } catch (const StageError& error) {
    EXPECT_EQ(std::string(error.what()),
              "no plane contains 25 % of the 1000 points; the largest contains 100");
  }
  EXPECT_NO_THROW(ground_from_planes(cloud, {level(60.0)}, {0.2, 0.05, 0.1}, rng));
}

TEST(GroundFromPlanes, NoPlaneAndNoPointIsNoGround) {
  Rng rng = test::test_rng(4);
  EXPECT_THROW(ground_from_planes({}, {level(0.0)}, {}, rng), StageError);
  const Points cloud = test::random_cloud(rng, 100, 5.0);
  EXPECT_THROW(ground_from_planes(cloud, {}, {}, rng), StageError);
  EXPECT_THROW(ground_from_planes(cloud, {level(100.0)}, {}, rng), StageError);
}

}  // namespace
}  // namespace croon
