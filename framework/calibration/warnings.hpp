#pragma once

#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// One sensor's cloud in one scene, as the warnings see it.
struct NamedCloud {
  std::string scene;
  std::string sensor;
  const LoadedCloud* cloud = nullptr;
};

/// What is suspicious about the clouds before anything is computed, one sentence each: two sensors
/// with the same content, scenes that are copies of each other, a median range that looks like
/// millimetres, centimetres or coordinates of a map, many points at exactly zero, few points, scans
/// of one scene far apart in time.
std::vector<std::string> warnings_about_clouds(const std::vector<NamedCloud>& clouds);

/// Whether the clouds have the same points in the same order, up to the rounding of a file with
/// millimetres.
bool have_same_points(const PointCloud& a, const PointCloud& b);

/// The scenes whose clouds are all copies of an earlier scene's: they do not count as evidence.
std::vector<std::string> copied_scenes(const std::vector<NamedCloud>& clouds);

/// What is suspicious about the results: a pose at zero, two sensors at one pose, a pose far from
/// nominal, near half a turn from it or near its inverse, two sensors that look swapped, one scene
/// alone.
std::vector<std::string> warnings_about_rig(const CalibratedRig& rig);

}  // namespace croon
