#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "framework/spatial/cloud.hpp"

namespace croon {

/// The parameters of features: the surface around a point, and the number of features.
struct FeatureOptions {
  double radius_m = 2.5;       ///< Of the surface around a point that describes it.
  int max_neighbours = 60;     ///< Maximum number of neighbours that describe a point.
  int normal_neighbours = 15;  ///< Number of neighbours for normals.
  int max_features = 4000;     ///< Maximum number of features per cloud.
};

/// A fast point feature histogram (FPFH): 3 angles of 11 bins, then zeros that fill a vector
/// register. Integers, so that distances are bitwise identical everywhere. The entries are the
/// roots of the relative frequencies (Arandjelovic and Zisserman, CVPR 2012), so that few bins do
/// not dominate.
using FeatureHistogram = std::array<std::int16_t, 40>;

/// Points of a cloud described by the surface around them.
struct PointFeatures {
  Points points;
  Points normals;  ///< Unit, towards the sensor.
  std::vector<FeatureHistogram> histograms;
};

/// The features of `cloud`, which must be thinned evenly: the points whose histograms differ most
/// from a plane's, because all points on a road look alike. Invariant to rotations of the cloud
/// about the sensor. After Rusu, Blodow and Beetz, Fast Point Feature Histograms (FPFH) for 3D
/// registration, ICRA 2009, equations 1 to 3. Empty for a cloud without normals.
PointFeatures point_features(const Cloud& cloud, const FeatureOptions& options);

/// A pair of similar points of two clouds.
struct FeatureMatch {
  int target = 0;  ///< Index in the target's features.
  int source = 0;  ///< Index in the source's features.
};

/// Criteria for corresponding features.
struct MatchOptions {
  /// Maximum difference of the features' distances from their sensors: for the same point, it is at
  /// most the distance between the sensors.
  double max_sensor_distance_m = 10.0;
  int candidates = 5;  ///< Number of most similar features considered for each feature.
};

/// The pairs of features each of which is among the `candidates` features most similar to the
/// other, in the order of the target's features.
std::vector<FeatureMatch> mutual_matches(const PointFeatures& target, const PointFeatures& source,
                                         const MatchOptions& options);

}  // namespace croon
