#include "framework/simulation/inner_triangle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "test/support/random_geometry.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

Corners draw_triangle(Rng& rng) {
  return {test::random_point(rng, 1.0), test::random_point(rng, 1.0), test::random_point(rng, 1.0)};
}

/// A point of the triangle, also near its edges and corners.
Vector3d draw_in(Rng& rng, const Corners& corners) {
  double u = rng.uniform(0.0, 1.0);
  double v = rng.uniform(0.0, 1.0);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
}

double distance_to_edges_m(const Corners& corners, const Vector3d& point) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d edge = (corners[(k + 1) % 3] - corners[k]).normalized();
    least_m = std::min(least_m, edge.cross(point - corners[k]).norm());
  }
  return least_m;
}

TEST(InnerTriangle, HoldsThePointsThatAreFarFromTheEdges) {
  constexpr double kInset_m = 0.05;
  Rng rng = test::test_rng();
  int held = 0;
  for (int i = 0; i < 2000; ++i) {
    const Corners corners = draw_triangle(rng);
    const InnerTriangle inner(corners, kInset_m);
    const Vector3d point = draw_in(rng, corners);
    const double edge_m = distance_to_edges_m(corners, point);
    if (std::abs(edge_m - kInset_m) < 1e-9) continue;
    EXPECT_EQ(inner.contains(point), edge_m > kInset_m);
    if (inner.is_empty()) {
      EXPECT_LT(edge_m, kInset_m);
    }
    held += inner.contains(point) ? 1 : 0;
    // Mirrored in the middle of an edge, the point is out of the triangle.
    EXPECT_FALSE(inner.contains(corners[0] + corners[1] - point));
  }
  EXPECT_GT(held, 1000);
}

TEST(InnerTriangle, WithoutAreaIsEmpty) {
  const Vector3d a(1.0, 2.0, 3.0);
  const Vector3d b(2.0, 2.0, 3.0);
  for (const Corners& corners : {Corners{a, a, a}, Corners{a, b, a}, Corners{a, b, 2.0 * b - a}}) {
    const InnerTriangle inner(corners, 0.01);
    EXPECT_TRUE(inner.is_empty());
    EXPECT_FALSE(inner.contains(a));
  }
}

/// No point of the one is so near to a point of the other.
TEST(InnerTriangle, SaysThatNoOtherIsNearOnlyWhereNoneIs) {
  constexpr double kInset_m = 0.02;
  constexpr double kNear_m = 0.1;
  Rng rng = test::test_rng();
  int near = 0;
  int far = 0;
  for (int i = 0; i < 3000; ++i) {
    const Corners corners = draw_triangle(rng);
    const InnerTriangle inner(corners, kInset_m);
    if (inner.is_empty()) continue;
    Corners other = draw_triangle(rng);
    const Vector3d shift = test::random_point(rng, 1.0);
    for (Vector3d& corner : other) corner += shift;
    if (!inner.is_farther_than(kNear_m, other)) {
      ++near;
      continue;
    }
    ++far;
    for (int k = 0; k < 200; ++k) {
      const Vector3d point = draw_in(rng, corners);
      if (!inner.contains(point)) continue;
      EXPECT_GT((point - draw_in(rng, other)).norm(), kNear_m);
    }
  }
  EXPECT_GT(near, 300);
  EXPECT_GT(far, 300);
}

TEST(InnerTriangle, IsAwayFromTheNeighboursAtItsEdges) {
  const Corners corners = {Vector3d(0.0, 0.0, 0.0), Vector3d(2.0, 0.0, 0.0),
                           Vector3d(0.0, 2.0, 0.0)};
  const InnerTriangle inner(corners, 4e-3);
  const auto at_edge = [](double angle_rad) {
    return Corners{Vector3d(2.0, 0.0, 0.0), Vector3d(0.0, 0.0, 0.0),
                   Vector3d(1.0, -2.0 * std::cos(angle_rad), 2.0 * std::sin(angle_rad))};
  };
  for (const double angle_rad : {0.0, 0.5, 1.5, 2.5}) {
    EXPECT_TRUE(inner.is_farther_than(6e-4, at_edge(angle_rad))) << angle_rad;
  }
  // Folded onto the triangle.
  EXPECT_FALSE(inner.is_farther_than(6e-4, at_edge(3.1415)));
  // A pole that stands on it.
  EXPECT_FALSE(inner.is_farther_than(
      6e-4, {Vector3d(0.5, 0.5, 0.0), Vector3d(0.6, 0.5, 0.0), Vector3d(0.5, 0.5, 3.0)}));
}

}  // namespace
}  // namespace croon::simulation
