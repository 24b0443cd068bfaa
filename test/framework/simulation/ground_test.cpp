#include "framework/simulation/ground.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// A random road with lines, and for half of the roads with a crossing.
RoadShape random_shape(Rng& rng) {
  RoadShape shape = test::random_road(rng);
  shape.lines = {{0.0, true}, {shape.half_width_m - 0.3, false}};
  if (rng.uniform() < 0.5) shape.crossing = Crossing{rng.uniform(-30.0, 30.0), 5.0};
  return shape;
}

TEST(Ground, IsASurfaceWithoutFoldsThroughItsPoints) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng = test::test_rng(seed);
    const Ground ground(random_shape(rng), StreamKey(seed));
    Mesh mesh;
    ground.add_to(mesh);
    ASSERT_EQ(mesh.triangles.size(), mesh.materials.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vector3d u = (mesh.vertices[b] - mesh.vertices[a]).cast<double>();
      const Vector3d v = (mesh.vertices[c] - mesh.vertices[a]).cast<double>();
      ASSERT_GT(u.cross(v).z(), 0.0) << "seed " << seed;
    }
  }
}

TEST(Ground, KeepsLengthsAlongItsCentreLineAndAcrossIt) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng = test::test_rng(seed);
    const Ground ground(random_shape(rng), StreamKey(seed));
    const auto level = [&](double s_m, double d_m) {
      return Eigen::Vector2d(ground.point(s_m, d_m).head<2>());
    };
    double length_m = 0.0;
    for (int i = 0; i < 1000; ++i) {
      length_m += (level(0.1 * (i + 1), 0.0) - level(0.1 * i, 0.0)).norm();
    }
    EXPECT_NEAR(length_m, 100.0, 1e-3);
    EXPECT_NEAR((level(37.0, 5.0) - level(37.0, -3.0)).norm(), 8.0, 1e-9);
  }
}

TEST(Ground, HasKerbsAndNoneOnACrossing) {
  RoadShape shape;
  shape.crossing = Crossing{20.0, 4.0};
  const Ground ground(shape, StreamKey(1));
  const double beyond_m = shape.half_width_m + 0.5;
  EXPECT_NEAR(shape.height_m(0.0, beyond_m) - shape.height_m(0.0, beyond_m - 0.6),
              shape.kerb_height_m, 1e-9);
  EXPECT_NEAR(shape.height_m(20.0, beyond_m), shape.height_m(20.0, 0.0), 1e-9);
}

TEST(Ground, CarriesACarOnItsSlope) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng = test::test_rng(seed);
    RoadShape shape = random_shape(rng);
    shape.crown = 0.0;
    shape.roughness_m = 0.0;
    const Ground ground(shape, StreamKey(seed));
    const double yaw_rad = rng.uniform(-3.0, 3.0);
    const RigidTransform pose = ground.on_slope(4.0, 0.5, yaw_rad);
    EXPECT_LT((pose.rotation * pose.rotation.transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-9);
    EXPECT_GT(pose.rotation(2, 2), 0.99);
    EXPECT_NEAR(pose.translation.z(), shape.height_m(4.0, 0.5), 0.01);
    const Vector3d ahead = pose * Vector3d(1.3, 0.0, 0.0);
    const double heading_rad = ground.heading_rad(4.0) + yaw_rad;
    EXPECT_NEAR(std::remainder(std::atan2(pose.rotation(1, 0), pose.rotation(0, 0)) - heading_rad,
                               2.0 * 3.141592653589793),
                0.0, 0.02);
    EXPECT_NEAR(ahead.z() - pose.translation.z(),
                1.3 * (shape.grade * std::cos(yaw_rad) + shape.banking * std::sin(yaw_rad)), 0.02);
  }
}

}  // namespace
}  // namespace croon::simulation
