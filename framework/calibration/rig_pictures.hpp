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

/// "1.2, 0.4, 3.0": the standard deviations of three degrees of freedom from `first` on, each
/// multiplied by `scale`.
std::string stds_text(const PoseCovariance& covariance, int first, double scale, int decimals);

/// The note for a calibrated sensor: its standard deviations, or the first reason for its
/// rejection.
std::string picture_note(const CalibratedSensor& sensor);

/// A picture of a calibration.
struct RigPicture {
  std::string file;    ///< The name of its file, "front.png".
  std::string sensor;  ///< Empty for the picture of the whole rig.
  std::string png;     ///< Its bytes.
};

/// Draws one scene: for each sensor with a pose the reference and the sensor from above and in
/// sections from the front and the side, before and after, with the verdict in the title
/// (`<sensor>.png`); and the accepted sensors from above (`rig.png`). If the reference sees the
/// ground, the pictures are level. file_names converts sensor names to file names.
std::vector<RigPicture> draw_rig_pictures(const std::string& reference, const Points& points,
                                          const std::vector<PosedCloud>& sensors);

/// Writes the clouds in the reference's frame to `folder`, which must exist, and returns the paths
/// of the files relative to it: `clouds/<sensor>.ply|pcd`, `clouds/<sensor>_rejected.ply|pcd` for
/// rejected sensors, and `clouds/fused.ply|pcd` with all accepted sensors. Throws InputError if a
/// file cannot be written.
std::vector<std::string> write_rig_clouds(const std::filesystem::path& folder,
                                          const std::string& reference, const Points& points,
                                          const std::vector<PosedCloud>& sensors);

/// A file name without suffix for each of the names: letters, digits, ".", "-" and "_" are kept,
/// other characters become "_", and separators at either end are removed ("/top/points" is
/// "top_points"). Names that would be equal on some file system, or equal to one of `taken`, get a
/// number ("top_points_2").
std::vector<std::string> file_names(const std::vector<std::string>& names,
                                    const std::vector<std::string>& taken);

}  // namespace croon
