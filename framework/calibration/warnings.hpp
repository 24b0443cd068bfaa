#pragma once

#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// One sensor's cloud in one scene.
struct NamedCloud {
  std::string scene;
  std::string sensor;
  const LoadedCloud* cloud = nullptr;
};

/// Warnings about suspicious clouds, one sentence each: two sensors with the same points, copied
/// scenes, a median range that suggests millimetres, centimetres or map coordinates, many points at
/// exactly zero, few points, scans of one scene far apart in time.
std::vector<std::string> warnings_about_clouds(const std::vector<NamedCloud>& clouds);

/// Whether the clouds have the same points in the same order, up to rounding to millimetres.
bool have_same_points(const PointCloud& a, const PointCloud& b);

/// The scenes whose clouds are all copies of an earlier scene's, and which are therefore no
/// evidence.
std::vector<std::string> copied_scenes(const std::vector<NamedCloud>& clouds);

/// Warnings about suspicious results: a pose at zero, two sensors with the same pose, a pose that
/// is far from the nominal one, about half a turn from it or near its inverse, two sensors that
/// appear swapped, an accepted pose that the clouds contradict, a scene that differs from the
/// others, a single scene.
std::vector<std::string> warnings_about_rig(const CalibratedRig& rig);

}  // namespace croon
