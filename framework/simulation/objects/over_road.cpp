#include "framework/simulation/objects/over_road.hpp"

#include <algorithm>
#include <cmath>

namespace croon::simulation {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d OverRoad::point(double s_m, double d_m, double above_m) const {
  const double kerb_m = ground_.shape().half_width_m;
  Vector3d place = ground_.point(s_m, d_m);
  if (above_m < 0.0) {
    place.z() = ground_.height_m(s_m, d_m) + above_m;
  } else {
    place.z() = std::max({ground_.height_m(s_m, -kerb_m), ground_.height_m(s_m, 0.0),
                          ground_.height_m(s_m, kerb_m)}) +
                above_m;
  }
  return place;
}

std::vector<Ring> OverRoad::rings(const std::vector<double>& places, const Profile& profile) const {
  std::vector<Ring> rings;
  for (const double s_m : places) {
    Ring& ring = rings.emplace_back();
    for (const Vector2d& corner : profile) ring.push_back(point(s_m, corner.x(), corner.y()));
  }
  return rings;
}

std::vector<double> places_between(double from_m, double to_m) {
  constexpr double kSegment_m = 5.0;
  const int segments = std::max(1, static_cast<int>(std::ceil((to_m - from_m) / kSegment_m)));
  std::vector<double> places;
  for (int i = 0; i < segments; ++i) places.push_back(from_m + (to_m - from_m) * i / segments);
  places.push_back(to_m);
  return places;
}

}  // namespace croon::simulation
