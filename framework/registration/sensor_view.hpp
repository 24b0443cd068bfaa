#pragma once

#include <memory>
#include <vector>

#include "framework/spatial/cloud.hpp"
#include "framework/spatial/range_image.hpp"

namespace croon {

/// What poses are judged by, of one cloud alone.
struct SensorView {
  std::shared_ptr<const Cloud> thinned;  ///< One point for each leaf, so that points are areas.
  RangeImage image;                      ///< Of all points.
  int normal_neighbours = 10;            ///< Of the thinned cloud's normals.
  std::vector<int> sample;               ///< Points of `thinned` with normals, see balanced_sample.
};

/// Indices of points of `cloud` with a normal, evenly through the cloud, such that surfaces of rare
/// directions are not lost among those of frequent ones: a point is taken with the weight 1/sqrt(n)
/// for n points whose normals have about its direction (after Rusinkiewicz and Levoy 2001,
/// normal-space sampling). A normal's sign does not matter. About `count` points: the number of
/// each direction is rounded.
std::vector<int> balanced_sample(const Cloud& cloud, int normal_neighbours, int count);

}  // namespace croon
