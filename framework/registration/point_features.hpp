#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "framework/spatial/cloud.hpp"

namespace croon {

/// How points are described by the surface around them, and which of them.
struct FeatureOptions {
  double radius_m = 2.5;       ///< Of the surface around a point that describes it.
  int neighbours = 60;         ///< At most the nearest so many points describe it.
  int normal_neighbours = 15;  ///< Of the normals.
  int features = 4000;         ///< At most so many points of a cloud are described.
};

/// A fast point feature histogram (FPFH): 3 angles of 11 bins, then zeros that fill a vector
/// register. Whole numbers, so that distances are the same bits everywhere. The entries are the
/// roots of the shares (Arandjelovic and Zisserman, CVPR 2012): then few bins do not outvote the
/// others.
using FeatureHistogram = std::array<std::int16_t, 40>;

/// Points of a cloud that are told apart by the surface around them.
struct PointFeatures {
  Points points;
  Points normals;  ///< Unit, towards the sensor.
  std::vector<FeatureHistogram> histograms;
};

/// The features of `cloud`, which is thinned evenly: of all points those whose histograms are the
/// least like a plane's, for a point on a road looks like any other. They do not change if the
/// cloud is turned about the sensor. After Rusu, Blodow and Beetz, Fast Point Feature Histograms
/// (FPFH) for 3D registration, ICRA 2009, equations 1 to 3. Empty for a cloud without normals.
PointFeatures point_features(const Cloud& cloud, const FeatureOptions& options);

/// A point of one cloud and a point of the other that look alike.
struct FeatureMatch {
  int target = 0;  ///< Index in the target's features.
  int source = 0;  ///< Index in the source's features.
};

/// Which features correspond.
struct MatchOptions {
  /// Only features are compared whose distances from their sensors differ by at most this: the
  /// distance between the sensors is no less for the same point seen by both.
  double reach_m = 10.0;
  int candidates = 5;  ///< Each feature corresponds to at most so many.
};

/// The pairs of features each of which is among the other's `candidates` most similar ones, in the
/// order of the target's.
std::vector<FeatureMatch> mutual_matches(const PointFeatures& target, const PointFeatures& source,
                                         const MatchOptions& options);

}  // namespace croon
