#include "framework/simulation/ray_caster.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "framework/simulation/embree.hpp"
#include "framework/simulation/objects/shapes.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// `count` triangles of a metre or two, anywhere within 10 m.
std::shared_ptr<World> soup(Rng& rng, int count) {
  auto world = std::make_shared<World>();
  Mesh& mesh = world->fixed;
  for (int i = 0; i < count; ++i) {
    const Vector3d middle = test::random_point(rng, 10.0);
    std::array<std::uint32_t, 3> corner{};
    for (std::uint32_t& index : corner)
      index = mesh.add_vertex(middle + test::random_point(rng, 1.0));
    mesh.add_triangle(corner[0], corner[1], corner[2], Material::brick);
  }
  return world;
}

/// The range to one triangle (Moeller and Trumbore 1997): infinite if the ray misses it, NaN if the
/// ray passes very close to an edge.
double range_m(const Ray& ray, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d p = ray.direction.cross(c - a);
  const double determinant = (b - a).dot(p);
  const Vector3d from = ray.origin - a;
  const double u = from.dot(p) / determinant;
  const Vector3d q = from.cross(b - a);
  const double v = ray.direction.dot(q) / determinant;
  constexpr double kNearEdge = 1e-4;
  const double inside = std::min({u, v, 1.0 - u - v});
  if (std::abs(inside) < kNearEdge) return std::numeric_limits<double>::quiet_NaN();
  const double t = (c - a).dot(q) / determinant;
  return inside > 0.0 && t > 0.0 ? t : std::numeric_limits<double>::infinity();
}

/// Processors with AVX have packets of eight rays, which are not the code of every processor.
TEST(RayCaster, RunsTheCodeOfEveryProcessor) {
  EXPECT_EQ(rtcGetDeviceProperty(embree_device(), RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED), 1);
  EXPECT_EQ(rtcGetDeviceProperty(embree_device(), RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED), 0);
}

/// Embree finds any of several triangles in one plane: which one depends on the last bits of its
/// ranges.
TEST(RayCaster, FindsTheFirstOfTrianglesInOnePlane) {
  Rng rng = test::test_rng(8);
  auto world = std::make_shared<World>();
  Mesh& mesh = world->fixed;
  for (int i = 0; i < 60; ++i) {
    std::array<std::uint32_t, 3> corner{};
    for (std::uint32_t& index : corner) {
      Vector3d point = test::random_point(rng, 2.0);
      point.x() = 5.0;
      index = mesh.add_vertex(point);
    }
    mesh.add_triangle(corner[0], corner[1], corner[2],
                      i % 2 == 0 ? Material::brick : Material::asphalt);
  }
  std::vector<Ray> rays(1000);
  for (Ray& ray : rays) {
    Vector3d target = test::random_point(rng, 1.0);
    target.x() = 5.0;
    ray.direction = target.normalized();
  }
  const std::vector<Hit> hits = RayCaster(world, {}).cast(rays, 0.5, 15.0);
  int compared = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    std::optional<std::size_t> first;
    bool is_clear = true;
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto corner = [&](int c) {
        return Vector3d(mesh.vertices[mesh.triangles[k][c]].cast<double>());
      };
      const double range = range_m(rays[i], corner(0), corner(1), corner(2));
      is_clear = is_clear && !std::isnan(range);
      if (!first && std::isfinite(range)) first = k;
    }
    if (!is_clear || !first) continue;
    ++compared;
    ASSERT_TRUE(hits[i].is_there());
    EXPECT_EQ(hits[i].material, mesh.materials[*first]);
  }
  EXPECT_GT(compared, 500);
}

TEST(RayCaster, AgreesWithBruteForce) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    Rng rng = test::test_rng(seed);
    const auto world = soup(rng, 200);
    // The number of rays is not a multiple of eight.
    std::vector<Ray> rays(501 + seed);
    for (Ray& ray : rays) {
      ray.origin = test::random_point(rng, 12.0);
      ray.direction = test::random_point(rng, 1.0).normalized();
    }
    constexpr double kMin_m = 0.5;
    constexpr double kMax_m = 15.0;
    const std::vector<Hit> hits = RayCaster(world, {}).cast(rays, kMin_m, kMax_m);
    ASSERT_EQ(hits.size(), rays.size());
    int compared = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      double least_m = std::numeric_limits<double>::infinity();
      bool is_clear = true;
      for (const auto& [a, b, c] : world->fixed.triangles) {
        const auto corner = [&](std::uint32_t k) {
          return Vector3d(world->fixed.vertices[k].cast<double>());
        };
        const double range = range_m(rays[i], corner(a), corner(b), corner(c));
        if (std::isnan(range) || std::abs(range - kMin_m) < 1e-4) is_clear = false;
        if (range >= kMin_m && range <= kMax_m) least_m = std::min(least_m, range);
      }
      if (!is_clear) continue;
      ++compared;
      EXPECT_EQ(hits[i].is_there(), std::isfinite(least_m));
      if (!hits[i].is_there()) continue;
      EXPECT_NEAR(hits[i].range_m, least_m, 1e-5);
    }
    EXPECT_GT(compared, 400);
  }
}

/// The caster learns which triangles have others near them. That must not change a bit: walls with
/// signs in front of them and behind them by less than single precision tells apart.
TEST(RayCaster, ARayHitsTheSameAloneAndAfterManyOthers) {
  int compared = 0;
  int signs = 0;
  for (std::uint64_t seed = 1; seed < 9; ++seed) {
    Rng rng = test::test_rng(seed);
    auto world = std::make_shared<World>();
    Mesh& mesh = world->fixed;
    const Eigen::Matrix3d turn = test::random_pose(rng, 1.0).rotation;
    const auto quad = [&](double x_m, double y_m, double z_m, double half_m, Material material) {
      mesh.add_quad(turn * Vector3d(x_m, y_m - half_m, z_m - half_m),
                    turn * Vector3d(x_m, y_m + half_m, z_m - half_m),
                    turn * Vector3d(x_m, y_m + half_m, z_m + half_m),
                    turn * Vector3d(x_m, y_m - half_m, z_m + half_m), material);
    };
    for (const double y_m : {-3.0, 0.0, 3.0}) quad(5.0, y_m, 0.0, 1.5, Material::brick);
    for (int i = 0; i < 8; ++i) {
      const Vector3d at = test::random_point(rng, 1.0);
      quad(5.0 + 1e-6 * at.x(), 4.0 * at.y(), at.z(), rng.uniform(0.05, 0.5), Material::sign);
    }
    std::vector<Ray> rays(2000);
    for (Ray& ray : rays) {
      ray.origin = test::random_point(rng, 0.1);
      const Vector3d at = test::random_point(rng, 1.0);
      const Vector3d target(5.0, 4.4 * at.y(), 1.4 * at.z());
      ray.direction = (turn * target - ray.origin).normalized();
    }
    const RayCaster among_others(world, {});
    const std::vector<Hit> hits = among_others.cast(rays, 0.5, 15.0);
    for (std::size_t i = 0; i < rays.size(); i += 10) {
      const Hit alone = RayCaster(world, {}).cast({rays[i]}, 0.5, 15.0).front();
      EXPECT_EQ(hits[i].range_m, alone.range_m);
      EXPECT_EQ(hits[i].incidence_cos, alone.incidence_cos);
      EXPECT_EQ(hits[i].material, alone.material);
      signs += alone.material == Material::sign ? 1 : 0;
      ++compared;
    }
  }
  EXPECT_GT(signs, compared / 20);
  EXPECT_LT(signs, compared / 2);
}

TEST(RayCaster, MeetsABodyWhereItIsAtTheRaysTime) {
  auto world = std::make_shared<World>();
  Body body;
  add_box(body.mesh, {-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}, Material::metal);
  body.T_world_body.translation = {10.0, 0.0, 0.0};
  body.motion.speed_mps = 30.0;
  world->bodies.push_back(body);
  const RayCaster caster(world, {-0.1, 0.2});
  for (const double time_s : {-0.1, 0.0, 0.05, 0.2}) {
    const Ray ray = {{0.0, 0.0, 1.0}, Vector3d::UnitX(), time_s};
    const Hit hit = caster.cast({ray}, 0.0, 100.0).front();
    ASSERT_TRUE(hit.is_there());
    EXPECT_NEAR(hit.range_m, 9.0 + 30.0 * time_s, 1e-4);
    EXPECT_NEAR(hit.incidence_cos, 1.0, 1e-6);
    EXPECT_EQ(hit.material, Material::metal);
  }
}

TEST(RayCaster, MeetsABodyThatTurnsThroughALongWindow) {
  auto world = std::make_shared<World>();
  Body body;
  add_box(body.mesh, {-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}, Material::metal);
  body.motion = {10.0, 0.5};
  world->bodies.push_back(body);
  const RayCaster caster(world, {0.0, 2.0});
  for (const double time_s : {0.0, 0.55, 1.0, 1.33, 2.0}) {
    // From 5 m ahead of the body, towards it.
    const RigidTransform pose = body.pose_at(time_s);
    const Ray ray = {pose * Vector3d(5.0, 0.3, 1.0), pose.rotation * -Vector3d::UnitX(), time_s};
    const Hit hit = caster.cast({ray}, 0.0, 100.0).front();
    ASSERT_TRUE(hit.is_there());
    EXPECT_NEAR(hit.range_m, 4.0, 0.007);
    EXPECT_NEAR(hit.incidence_cos, 1.0, 1e-3);
  }
}

TEST(RayCaster, MeetsNothingInAnEmptyWorld) {
  const RayCaster caster(std::make_shared<World>(), {});
  EXPECT_FALSE(caster.cast({Ray{}}, 0.0, 1000.0).front().is_there());
  EXPECT_TRUE(caster.cast({}, 0.0, 1000.0).empty());
}

TEST(Body, MovesOnAnArc) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    Body body;
    body.T_world_body = test::random_pose(rng, 20.0);
    body.motion = {rng.uniform(-5.0, 30.0), rng.uniform(-0.5, 0.5)};
    // Many small straight steps lead to the same pose.
    constexpr int kSteps = 20000;
    const double step_s = 0.7 / kSteps;
    RigidTransform stepped = body.T_world_body;
    const RigidTransform step = {rotation_from_rpy({0.0, 0.0, body.motion.yaw_rate_radps * step_s}),
                                 {body.motion.speed_mps * step_s, 0.0, 0.0}};
    for (int k = 0; k < kSteps; ++k) stepped = stepped * step;
    const RigidTransform pose = body.pose_at(0.7);
    EXPECT_LT((pose.translation - stepped.translation).norm(), 1e-3);
    EXPECT_LT((pose.rotation - stepped.rotation).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace croon::simulation
