// Boundaries are closed along their lines, and what encloses a road leaves its carriageway free.
#include "framework/simulation/scenes/boundaries.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;
using test::caster_of;
using test::test_rng;

constexpr std::uint64_t kBoundarySeeds = 20;
constexpr double kBeside_m = 1.0;  ///< Where rays across a boundary begin.

/// The share of rays across the line at `d_m`, `above_m` over the ground at random s of `along_m`,
/// that meet `mesh`.
double stopped_share(const Mesh& mesh, const Ground& ground, const Span& along_m, double d_m,
                     double above_m, Rng& rng) {
  constexpr int kRays = 500;
  std::vector<Ray> rays;
  for (int i = 0; i < kRays; ++i) {
    const double s_m = draw(rng, along_m);
    const double yaw_rad = ground.heading_rad(s_m) + 0.5 * kPi;
    Vector3d origin = ground.point(s_m, d_m - kBeside_m);
    origin.z() = ground.point(s_m, d_m, above_m).z();
    rays.push_back({origin, {std::cos(yaw_rad), std::sin(yaw_rad), 0.0}, 0.0});
  }
  int stopped = 0;
  for (const Hit& hit : caster_of(mesh)->cast(rays, 0.0, 2.0 * kBeside_m)) {
    stopped += hit.is_there();
  }
  return static_cast<double>(stopped) / kRays;
}

TEST(AddBoundaryPieces, IsClosedOverItsWholeLength) {
  for (std::uint64_t seed = 1; seed <= kBoundarySeeds / 2; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    const RoadShape shape = test::random_road(rng);
    const Ground ground(shape, StreamKey(seed).with("ground"));
    const double out_m = shape.half_width_m + rng.uniform(0.5, 6.0);
    const Span along_m = {-rng.uniform(5.0, 45.0), rng.uniform(5.0, 45.0)};
    for (const BoundaryType type :
         {BoundaryType::garden_wall, BoundaryType::noise_wall, BoundaryType::hedge,
          BoundaryType::jersey_barrier, BoundaryType::guard_rail}) {
      for (const Roadside& side : both_sides()) {
        SceneBuilder builder(shape, StreamKey(seed));
        add_boundary_pieces(builder, side, along_m, out_m, {type, 1.2}, Rng(StreamKey(seed)));
        const Mesh boundary = test::without_ground(builder.finish(), shape);
        EXPECT_GT(stopped_share(boundary, ground, along_m, side.sign * out_m, 0.6, rng), 0.99)
            << "type " << static_cast<int>(type);
        const Span beyond_m = {along_m.to + 1.0, along_m.to + 20.0};
        EXPECT_EQ(stopped_share(boundary, ground, beyond_m, side.sign * out_m, 0.6, rng), 0.0);
      }
    }
  }
}

TEST(AddBoundaryPieces, LeavesOutThePiecesWithoutSpace) {
  for (std::uint64_t seed = 1; seed <= kBoundarySeeds; ++seed) {
    Rng rng = test_rng(seed);
    const RoadShape shape = test::random_road(rng);
    const Ground ground(shape, StreamKey(seed).with("ground"));
    const double out_m = shape.half_width_m + 2.0;
    SceneBuilder builder(shape, StreamKey(seed));
    const Roadside side = both_sides()[seed % 2];
    builder.keep_clear(side.box({2.0, 6.0}, {out_m - 1.0, out_m + 1.0}, 2.0));
    add_boundary_pieces(builder, side, {-20.0, 20.0}, out_m, {BoundaryType::noise_wall, 2.0},
                        Rng(StreamKey(seed)));
    const Mesh boundary = test::without_ground(builder.finish(), shape);
    const double d_m = side.sign * out_m;
    EXPECT_EQ(stopped_share(boundary, ground, {0.5, 9.5}, d_m, 1.0, rng), 0.0);
    EXPECT_GT(stopped_share(boundary, ground, {-20.0, 0.0}, d_m, 1.0, rng), 0.99);
    EXPECT_GT(stopped_share(boundary, ground, {10.0, 20.0}, d_m, 1.0, rng), 0.99);
  }
}

TEST(AddBoundary, AddsAllOrNothingAndTakesItsSpace) {
  SceneBuilder builder(RoadShape{}, StreamKey(1));
  Rng rng = test_rng();
  const RoadLine line = {RoadPose{0.0, 6.0, 0.0}, RoadPose{0.0, 14.0, 0.0}};
  EXPECT_TRUE(add_boundary(builder, line, {BoundaryType::fence, 1.5}, rng));
  EXPECT_FALSE(add_boundary(builder, line, {BoundaryType::fence, 1.5}, rng));
  EXPECT_FALSE(builder.is_free(road_box({-0.1, 0.1}, {7.0, 8.0}, 1.0)));
  EXPECT_TRUE(builder.is_free(road_box({0.6, 2.0}, {7.0, 8.0}, 1.0)));
}

TEST(SmoothWalls, AreAtTheirFaceUpToTheirHeight) {
  for (std::uint64_t seed = 1; seed <= kBoundarySeeds; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = test_rng(seed);
    RoadShape shape = test::random_road(rng);
    shape.curvature_per_m /= 3.0;
    const Ground ground(shape, StreamKey(seed).with("ground"));
    SceneBuilder builder(shape, StreamKey(seed));
    std::array<SmoothWall, 2> walls;
    for (std::size_t i = 0; i < 2; ++i) {
      walls[i].along_m = {-60.0, 60.0};
      walls[i].face_m = rng.uniform(2.0, 8.0);
      walls[i].height_m = rng.uniform(4.0, 8.0);
      add_smooth_wall(builder, both_sides()[i], walls[i]);
    }
    add_ceiling(builder, walls);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_FALSE(
          builder.is_free(both_sides()[i].box({0.0, 1.0}, {walls[i].face_m + 0.1, 9.0}, 2.0)));
      EXPECT_TRUE(builder.is_free(both_sides()[i].box({0.0, 1.0}, {0.0, walls[i].face_m}, 2.0)));
    }
    std::vector<Ray> rays;
    std::vector<double> expected_m;
    for (int k = 0; k < 300; ++k) {
      const double s_m = rng.uniform(-50.0, 50.0);
      const Vector3d origin = ground.point(s_m, 0.0, 1.5);
      for (std::size_t i = 0; i < 2; ++i) {
        const double yaw_rad = ground.heading_rad(s_m) + (i == 0 ? 0.5 : -0.5) * kPi;
        rays.push_back({origin, {std::cos(yaw_rad), std::sin(yaw_rad), 0.0}, 0.0});
        expected_m.push_back(walls[i].face_m);
      }
      rays.push_back({origin, Vector3d::UnitZ(), 0.0});
      expected_m.push_back(std::min(walls[0].height_m, walls[1].height_m) - 1.5);
    }
    const Mesh mesh = test::without_ground(builder.finish(), shape);
    const std::vector<Hit> hits = caster_of(mesh)->cast(rays, 0.0, 50.0);
    for (std::size_t k = 0; k < hits.size(); ++k) {
      // The chords of the path are up to 4 m long; crown and banking change the ceiling's height.
      EXPECT_NEAR(hits[k].range_m, expected_m[k], k % 3 == 2 ? 0.6 : 0.03);
    }
  }
}

TEST(Structures, TakeAllSpaceButTheCarriageway) {
  for (std::uint64_t seed = 1; seed <= kBoundarySeeds; ++seed) {
    Rng rng = test_rng(seed);
    const RoadShape shape = test::random_road(rng);
    SceneBuilder builder(shape, StreamKey(seed));
    const double from_m = rng.uniform(-60.0, 60.0);
    const Span along_m = {from_m, from_m + rng.uniform(8.0, 80.0)};
    if (seed % 2 == 0) {
      add_bridge(builder, along_m, rng);
    } else {
      add_tunnel(builder, along_m, rng);
    }
    const double kerb_m = shape.half_width_m;
    const Span inside_m = {along_m.middle() - 1.0, along_m.middle() + 1.0};
    EXPECT_TRUE(builder.is_free(road_box(inside_m, {-kerb_m, kerb_m}, 4.0)));
    EXPECT_FALSE(builder.is_free(road_box(inside_m, {-kerb_m, kerb_m}, 5.0)));
    EXPECT_FALSE(builder.is_free(road_box(inside_m, {kerb_m + 1.0, kerb_m + 2.0}, 1.0)));
    EXPECT_FALSE(builder.is_free(road_box(inside_m, {-kerb_m - 2.0, -kerb_m - 1.0}, 1.0)));
    const Span beyond_m = {along_m.to + 1.5, along_m.to + 3.0};
    EXPECT_TRUE(builder.is_free(road_box(beyond_m, {-50.0, 50.0}, 10.0)));
  }
}

}  // namespace
}  // namespace croon::simulation
