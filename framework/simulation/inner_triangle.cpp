#include "framework/simulation/inner_triangle.hpp"

#include <algorithm>

namespace croon::simulation {

using Eigen::Vector3d;

InnerTriangle::Planes InnerTriangle::planes_of(const Corners& corners) {
  Planes planes = {plane_of(corners)};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d outwards = outwards_of_edge(corners, k, planes[0].normal);
    planes[k + 1] = {outwards, -outwards.dot(corners[k])};
  }
  return planes;
}

InnerTriangle::InnerTriangle(const Corners& corners, double inset_m) : planes_(planes_of(corners)) {
  const auto& [a, b, c] = corners;
  // The incentre weights each corner by the length of the opposite edge. The inradius is twice the
  // area divided by the sum of these lengths.
  const Vector3d lengths_m((c - b).norm(), (a - c).norm(), (b - a).norm());
  const double around_m = lengths_m.sum();
  if (around_m <= 0.0) return;
  const Vector3d centre = (lengths_m[0] * a + lengths_m[1] * b + lengths_m[2] * c) / around_m;
  const double radius_m = (b - a).cross(c - a).norm() / around_m;
  is_empty_ = radius_m <= inset_m;
  if (is_empty_) return;
  for (std::size_t k = 0; k < 3; ++k) {
    corners_[k] = centre + (1.0 - inset_m / radius_m) * (corners[k] - centre);
    planes_[k + 1].offset_m += inset_m;
  }
}

bool InnerTriangle::contains(const Vector3d& point) const {
  if (is_empty_) return false;
  return std::all_of(planes_.begin() + 1, planes_.end(),
                     [&](const Plane& edge) { return edge.signed_distance(point) < 0.0; });
}

bool InnerTriangle::is_farther_than(double distance_m, const Corners& other) const {
  const auto are_above = [&](const Corners& corners, const Plane& plane) {
    return std::all_of(corners.begin(), corners.end(), [&](const Vector3d& corner) {
      return plane.signed_distance(corner) > distance_m;
    });
  };
  const auto separates = [&](const Planes& planes, const Corners& corners) {
    return are_above(corners, planes[0].flipped()) ||
           std::any_of(planes.begin(), planes.end(),
                       [&](const Plane& plane) { return are_above(corners, plane); });
  };
  return separates(planes_, other) || separates(planes_of(other), corners_);
}

}  // namespace croon::simulation
