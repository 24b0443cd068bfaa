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
  std::optional<RigidTransform> before = {};  ///< The nominal T_reference_sensor, if any.
  std::optional<RigidTransform> after = {};   ///< The result or the best guess.
  bool is_accepted = true;
  /// One line below the verdict, with standard deviations or a reason; may be empty.
  std::string note = {};
};

/// The note for a calibrated sensor: its standard deviations, or the first reason for its
/// rejection.
std::string picture_note(const CalibratedSensor& sensor);

/// Writes the pictures and clouds of one scene to `folder`, which must exist, and returns the paths
/// of the files relative to it: `<sensor>.png` for each sensor with a pose (the reference and the
/// sensor from above and in sections from the front and the side, before and after, with the
/// verdict in the title), `rig.png` (the accepted sensors from above), and, if `with_clouds`, the
/// clouds in the reference's frame: `clouds/<sensor>.ply|pcd`, `clouds/<sensor>_rejected.ply|pcd`
/// for rejected sensors, and `clouds/fused.ply|pcd` with all accepted sensors. If the reference
/// sees the ground, the pictures are level. file_names converts sensor names to file names. Throws
/// InputError if a file cannot be written.
std::vector<std::string> write_rig_pictures(const std::filesystem::path& folder,
                                            const std::string& reference, const Points& points,
                                            const std::vector<PosedCloud>& sensors,
                                            bool with_clouds);

/// A file name without suffix for each of the names: letters, digits, ".", "-" and "_" are kept,
/// other characters become "_", and separators at either end are removed ("/top/points" is
/// "top_points"). Names that would be equal on some file system, or equal to one of `taken`, get a
/// number ("top_points_2").
std::vector<std::string> file_names(const std::vector<std::string>& names,
                                    const std::vector<std::string>& taken);

}  // namespace croon
