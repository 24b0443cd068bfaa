// Barriers follow their path within their height and thickness, without gaps at its corners.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "framework/simulation/objects/objects.hpp"
#include "test/support/mesh_checks.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::caster_of;
using test::test_rng;

constexpr std::uint64_t kBarrierSeeds = 60;

/// Up to eight pieces of 1 to 4 m that turn by up to 60 degrees and rise a little.
Path draw_path(Rng& rng) {
  Path path = {{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0), rng.uniform(-1.0, 1.0)}};
  double yaw_rad = rng.uniform(-3.0, 3.0);
  const std::uint64_t pieces = 1 + rng.below(8);
  for (std::uint64_t i = 0; i < pieces; ++i) {
    const double length_m = rng.uniform(1.0, 4.0);
    const double rise_m = rng.uniform(-0.05, 0.05) * length_m;
    path.push_back(path.back() +
                   Vector3d(length_m * std::cos(yaw_rad), length_m * std::sin(yaw_rad), rise_m));
    yaw_rad += rng.uniform(-0.3, 0.3) + (i % 3 == 1 ? 0.7 : 0.0);
  }
  return path;
}

/// Calls `check` with a path for each seed.
void for_each_path(const std::function<void(const Path& path, Rng& rng)>& check) {
  for (std::uint64_t seed = 1; seed <= kBarrierSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const Path path = draw_path(rng);
    check(path, rng);
  }
}

double length_of(const Path& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  return length_m;
}

/// How far to the side of the path and above it `point` is.
Vector2d beside_and_above(const Path& path, const Vector3d& point) {
  Vector2d nearest(1e9, 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector3d way = path[i] - path[i - 1];
    const Vector2d level = way.head<2>();
    const double share = (point - path[i - 1]).head<2>().dot(level) / level.squaredNorm();
    const Vector3d foot = path[i - 1] + std::clamp(share, 0.0, 1.0) * way;
    const double beside_m = (point - foot).head<2>().norm();
    if (beside_m < nearest.x()) nearest = {beside_m, point.z() - foot.z()};
  }
  return nearest;
}

/// Expects all of `mesh` within `half_m` of the path, a mitre of 60 degrees counted in, and between
/// 0.3 m below it and `height_m` above it.
void expect_within(const Mesh& mesh, const Path& path, double half_m, double height_m) {
  constexpr double kMitre = 1.16;
  constexpr double kSlope_m = 0.02;
  double highest_m = 0.0;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    const Vector2d offset = beside_and_above(path, vertex.cast<double>());
    ASSERT_LE(offset.x(), kMitre * half_m + 1e-3);
    ASSERT_GE(offset.y(), -0.3 - kSlope_m);
    ASSERT_LE(offset.y(), height_m + kSlope_m);
    highest_m = std::max(highest_m, offset.y());
  }
  EXPECT_NEAR(highest_m, height_m, 0.05);
}

constexpr double kFrom_m = 0.5;  ///< Where rays across a path begin, beside it.

/// A ray across `piece` of the path, `above_m` over it, `share` of the way along.
Ray ray_across(const Path& path, std::size_t piece, double share, double above_m) {
  const Vector3d way = path[piece + 1] - path[piece];
  const Vector3d across = Vector3d(-way.y(), way.x(), 0.0).normalized();
  return {path[piece] + share * way + Vector3d(0.0, 0.0, above_m) - kFrom_m * across, across, 0.0};
}

/// The share of rays across the path at `above_m`, anywhere along it, that `mesh` stops.
double stopped_share(const Mesh& mesh, const Path& path, double above_m, Rng& rng) {
  constexpr int kRays = 1000;
  std::vector<Ray> rays;
  for (int i = 0; i < kRays; ++i) {
    const std::size_t piece = rng.below(path.size() - 1);
    rays.push_back(ray_across(path, piece, rng.uniform(), above_m));
  }
  int stopped = 0;
  for (const Hit& hit : caster_of(mesh)->cast(rays, 0.0, 2.0 * kFrom_m)) stopped += hit.is_there();
  return static_cast<double>(stopped) / kRays;
}

Path straight_path() { return {{0.0, 0.0, 0.0}, {3.0, 0.5, 0.1}, {6.0, 0.5, 0.0}}; }

TEST(Barriers, AreDrawnFromTheirGeneratorAlone) {
  test::expect_drawn_from_its_rng([](Rng& rng) { return make_fence(straight_path(), 1.2, rng); });
  test::expect_drawn_from_its_rng(
      [](Rng& rng) { return make_garden_wall(straight_path(), 1.2, rng); });
  test::expect_drawn_from_its_rng([](Rng& rng) { return make_guard_rail(straight_path(), rng); });
}

TEST(Wall, IsAsThickAndHighAsAskedAndHasNoGap) {
  for_each_path([](const Path& path, Rng& rng) {
    const double height_m = rng.uniform(0.5, 5.0);
    const double thickness_m = rng.uniform(0.1, 0.5);
    const Mesh mesh = make_wall(path, height_m, thickness_m, Material::concrete);
    test::expect_sound(mesh, 12 * (path.size() - 1));
    expect_within(mesh, path, 0.5 * thickness_m, height_m);
    EXPECT_EQ(stopped_share(mesh, path, rng.uniform(0.0, height_m), rng), 1.0);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      rays.push_back(ray_across(path, i, 0.5, 0.5 * height_m));
    }
    for (const Hit& hit : caster_of(mesh)->cast(rays, 0.0, kFrom_m)) {
      EXPECT_NEAR(hit.range_m, kFrom_m - 0.5 * thickness_m, 1e-3);
    }
  });
}

TEST(GardenWall, StaysWithinItsHeightAndHasNoGap) {
  for_each_path([](const Path& path, Rng& rng) {
    const double height_m = rng.uniform(0.5, 2.4);
    const Mesh mesh = make_garden_wall(path, height_m, rng);
    test::expect_sound(mesh, 24 * path.size() + static_cast<std::size_t>(6.0 * length_of(path)));
    expect_within(mesh, path, 0.29, height_m);
    EXPECT_EQ(stopped_share(mesh, path, rng.uniform(0.0, height_m - 0.25), rng), 1.0);
  });
}

TEST(Fence, StopsSomeRaysAndNotOthers) {
  for_each_path([](const Path& path, Rng& rng) {
    const double height_m = rng.uniform(0.5, 2.4);
    const Mesh mesh = make_fence(path, height_m, rng);
    test::expect_sound(mesh, static_cast<std::size_t>(80.0 * length_of(path)));
    expect_within(mesh, path, 0.1, height_m);
    const double stopped = stopped_share(mesh, path, 0.5 * height_m, rng);
    EXPECT_GT(stopped, 0.08);
    EXPECT_LT(stopped, 0.99);
  });
}

TEST(GuardRail, IsClosedAtItsBeamAndOpenBelow) {
  for_each_path([](const Path& path, Rng& rng) {
    const Mesh mesh = make_guard_rail(path, rng);
    test::expect_sound(mesh, 24 * path.size() + static_cast<std::size_t>(6.0 * length_of(path)));
    expect_within(mesh, path, 0.14, 0.74);
    EXPECT_EQ(stopped_share(mesh, path, 0.6, rng), 1.0);
    EXPECT_LT(stopped_share(mesh, path, 0.2, rng), 0.3);
  });
}

TEST(JerseyBarrier, IsEightyCentimetresHighAndHasNoGap) {
  for_each_path([](const Path& path, Rng& rng) {
    const Mesh mesh = make_jersey_barrier(path);
    test::expect_sound(mesh, 18 * path.size());
    expect_within(mesh, path, 0.3, 0.8);
    EXPECT_EQ(stopped_share(mesh, path, rng.uniform(0.0, 0.75), rng), 1.0);
  });
}

}  // namespace
}  // namespace croon::simulation
