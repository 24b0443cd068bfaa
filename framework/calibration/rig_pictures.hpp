#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// One sensor's cloud with its poses before and after the calibration.
struct PosedCloud {
  std::string sensor;
  const Points* points = nullptr;             ///< In the sensor's frame.
  std::optional<RigidTransform> before = {};  ///< T_reference_sensor: nominal; else none.
  std::optional<RigidTransform> after = {};   ///< The result, or the best guess.
  bool is_accepted = true;
};

/// Writes the pictures and the clouds of one scene to `folder`, which must exist, and returns the
/// paths of what it wrote, relative to it: per sensor `<sensor>.png` (top, front and side views of
/// the reference and the sensor, before and after; the verdict in the title), `rig.png` (all
/// sensors from above), and, with `with_clouds`, `clouds/<sensor>.ply|pcd` and `clouds/fused.ply`
/// in the reference's frame. Throws InputError if a file cannot be written.
std::vector<std::string> write_rig_pictures(const std::filesystem::path& folder,
                                            const std::string& reference, const Points& points,
                                            const std::vector<PosedCloud>& sensors,
                                            bool with_clouds);

}  // namespace croon
