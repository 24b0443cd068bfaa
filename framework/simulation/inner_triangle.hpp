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

/// The direction in a triangle with the unit normal `normal` that leaves it across the edge from
/// corner `k` to the next one. Of length 1.
inline Eigen::Vector3d outwards_of_edge(const Corners& corners, std::size_t k,
                                        const Eigen::Vector3d& normal) {
  return (corners[(k + 1) % 3] - corners[k]).normalized().cross(normal);
}

/// The part of a triangle that is farther than `inset_m` from its edges. It tells quickly that no
/// other triangle is near a point.
class InnerTriangle {
 public:
  InnerTriangle(const Corners& corners, double inset_m);

  /// Whether no part is left: the radius of the incircle is `inset_m` or less.
  bool is_empty() const { return is_empty_; }
  /// Whether `point`, which lies in the triangle's plane, is in the part.
  bool holds(const Eigen::Vector3d& point) const;
  /// Whether a plane leaves more than `distance_m` between the part and all of `other`. Planes
  /// along the faces and upright on the edges of both triangles are tried, so false says nothing.
  bool is_farther_than(double distance_m, const Corners& other) const;

 private:
  using Planes = std::array<Plane, 4>;

  /// The plane of the triangle, then those upright on its edges, with normals outwards.
  static Planes planes_of(const Corners& corners);

  Planes planes_ = {};  ///< Those on the edges are moved inwards.
  Corners corners_ = {};
  bool is_empty_ = true;
};

}  // namespace croon::simulation
