#pragma once

#include <Eigen/Core>
#include <array>

namespace croon::simulation {

/// The corners of a triangle, metres.
using Corners = std::array<Eigen::Vector3d, 3>;

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
  /// The points p with `normal . p = offset_m`.
  struct Plane {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double offset_m = 0.0;
  };
  using Planes = std::array<Plane, 4>;

  /// The plane of the triangle, then those upright on its edges, with normals outwards.
  static Planes planes_of(const Corners& corners);

  Planes planes_ = {};  ///< Those on the edges are moved inwards.
  Corners corners_ = {};
  bool is_empty_ = true;
};

}  // namespace croon::simulation
