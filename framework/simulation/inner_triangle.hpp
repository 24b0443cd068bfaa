#pragma once

#include <Eigen/Geometry>
#include <array>

#include "framework/geometry/plane.hpp"

namespace croon::simulation {

/// The corners of a triangle, metres.
using Corners = std::array<Eigen::Vector3d, 3>;

/// The plane of a triangle. Its normal is zero if the triangle has no area.
inline Plane plane_of(const Corners& corners) {
  const auto& [a, b, c] = corners;
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  return {normal, -normal.dot(a)};
}

/// The unit vector in the plane of a triangle, with the unit normal `normal`, that points outwards
/// across the edge from corner `k` to the next one.
inline Eigen::Vector3d outwards_of_edge(const Corners& corners, std::size_t k,
                                        const Eigen::Vector3d& normal) {
  return (corners[(k + 1) % 3] - corners[k]).normalized().cross(normal);
}

/// The part of a triangle farther than `inset_m` from its edges: a quick test that no other
/// triangle is near a point.
class InnerTriangle {
 public:
  InnerTriangle(const Corners& corners, double inset_m);

  /// Whether the part is empty: the inradius is `inset_m` or less.
  bool is_empty() const { return is_empty_; }
  /// Whether `point`, which must lie in the triangle's plane, is in the part.
  bool contains(const Eigen::Vector3d& point) const;
  /// Whether a plane separates the part from `other` by more than `distance_m`. Only the planes of
  /// the two triangles and those perpendicular to them through their edges are tried, so false is
  /// inconclusive.
  bool is_farther_than(double distance_m, const Corners& other) const;

 private:
  using Planes = std::array<Plane, 4>;

  /// The plane of the triangle, then the perpendicular planes through its edges, with outward
  /// normals.
  static Planes planes_of(const Corners& corners);

  Planes planes_ = {};  ///< The edge planes are moved inwards.
  Corners corners_ = {};
  bool is_empty_ = true;
};

}  // namespace croon::simulation
