#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/geometry/pose_covariance.hpp"
#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// One sensor's pose in a file of extrinsics.
struct ExtrinsicPose {
  std::string sensor;  ///< The child frame.
  RigidTransform T_parent_sensor;
  bool is_accepted = true;
  std::optional<PoseCovariance> covariance = {};
  /// False for a rejected sensor without a best guess, which only `csv` lists.
  bool has_pose = true;
  bool is_doubtful = false;  ///< Accepted, but contradicted by the fit check of a calibration.
};

/// The poses of a rig's sensors in one parent frame.
struct Extrinsics {
  std::string parent;  ///< The reference sensor, or the vehicle frame ("base_link").
  std::vector<ExtrinsicPose> poses;
};

/// The name and content of a file to be written.
struct ExtrinsicsFile {
  std::string name;
  std::string text;
};

/// The names of the formats: ros2, ros2-yaml, urdf, autoware, apollo, kitti, nuscenes, kalibr,
/// opencalib, matrix, csv. docs/calibrate.md explains their conventions.
std::vector<std::string> extrinsics_format_names();

/// The poses as files of `format`. Rejected poses are omitted unless `with_rejected` is set, and
/// are then marked if the format allows it; `csv` always lists all of them with their verdict.
/// Throws InputError, with the nearest name, for an unknown format.
std::vector<ExtrinsicsFile> write_extrinsics(const Extrinsics& extrinsics,
                                             const std::string& format, bool with_rejected);

/// Reads poses from a file in any of these formats or croon's own (extrinsics.json, nominal.json),
/// recognised by its content. Throws InputError for unknown content, a matrix that is not a
/// rotation, a quaternion without unit length, or a missing value.
Extrinsics read_extrinsics(const std::filesystem::path& file);

/// The poses in the frame `new_parent`; `T_new_parent` maps the old parent to it.
Extrinsics in_frame(const Extrinsics& extrinsics, const std::string& new_parent,
                    const RigidTransform& T_new_parent);

/// The poses `T_reference_sensor` of all sensors but the reference. If the parent is not
/// `reference`, the file must have a pose of the reference, which is inverted and removed. Throws
/// InputError, naming `file`, if it has none.
Extrinsics in_frame_of_sensor(const Extrinsics& extrinsics, const std::string& reference,
                              const std::string& file);

}  // namespace croon
