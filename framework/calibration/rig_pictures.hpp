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
  std::string note = {};  ///< One line below the verdict: the deviations, the reason; may be empty.
};

/// The note for a calibrated sensor: its standard deviations, or the first reason for which it was
/// rejected.
std::string picture_note(const CalibratedSensor& sensor);

/// Writes the pictures and the clouds of one scene to `folder`, which must exist, and returns the
/// paths of what it wrote, relative to it: per sensor with a pose `<sensor>.png` (from above, and
/// sections seen from the front and the side, of the reference and the sensor, before and after;
/// the verdict in the title), `rig.png` (the accepted sensors from above), and, with
/// `with_clouds`, the clouds in the reference's frame: `clouds/<sensor>.ply|pcd`, of a rejected
/// sensor `clouds/<sensor>_rejected.ply|pcd`, and of all accepted sensors `clouds/fused.ply|pcd`.
/// If the reference sees the ground, the pictures are level. Names of sensors become file names
/// by file_names. Throws InputError if a file cannot be written.
std::vector<std::string> write_rig_pictures(const std::filesystem::path& folder,
                                            const std::string& reference, const Points& points,
                                            const std::vector<PosedCloud>& sensors,
                                            bool with_clouds);

/// A file name, without suffix, for each of the names: letters, digits, ".", "-" and "_" are kept,
/// others become "_", without one at either end ("/top/points" is "top_points"). Names that would
/// be equal on any file system, or equal to one of `taken`, get a number ("top_points_2").
std::vector<std::string> file_names(const std::vector<std::string>& names,
                                    const std::vector<std::string>& taken);

}  // namespace croon
