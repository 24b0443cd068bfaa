#pragma once

#include <memory>
#include <vector>

#include "framework/spatial/cloud.hpp"
#include "framework/spatial/range_image.hpp"

namespace croon {

/// The data of one cloud for judging poses.
struct SensorView {
  std::shared_ptr<const Cloud> thinned;  ///< One point per leaf, so that counts measure area.
  RangeImage image;                      ///< Of all points.
  int normal_neighbours = 10;            ///< For the normals of the thinned cloud.
  std::vector<int> sample;               ///< Points of `thinned` with normals, see balanced_sample.
};

/// Indices of points of `cloud` that have a normal, evenly spaced, such that surfaces of rare
/// directions are not lost among those of frequent ones: a point has the weight 1/sqrt(n) for n
/// points whose normals have about the same direction (after Rusinkiewicz and Levoy 2001,
/// normal-space sampling). A normal's sign does not matter. Returns about `count` points, because
/// the number for each direction is rounded.
std::vector<int> balanced_sample(const Cloud& cloud, int normal_neighbours, int count);

}  // namespace croon
