#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// `T_reference_sensor` by sensor name.
using RigPoses = std::map<std::string, RigidTransform>;

/// Reads the poses of a rig: `{"front": {"rotation_rpy_deg": [roll, pitch, yaw], "translation_m":
/// [x, y, z]}}` with `R = Rz(yaw) Ry(pitch) Rx(roll)`. Throws InputError with every fault.
RigPoses read_rig_poses(const std::filesystem::path& file);

/// The text of such a file; angles are rounded to 1e-9 degrees.
std::string rig_poses_json(const RigPoses& poses);

/// The pose obtained by writing and reading `T_reference_sensor`: equal to 1e-9 degrees, and
/// unchanged by further writing and reading. If the pitch is within a millidegree of 90 degrees,
/// roll and yaw are less exact.
RigidTransform pose_as_written(const RigidTransform& T_reference_sensor);

/// The types of scenes by scene name.
using SceneKinds = std::map<std::string, std::string>;

/// Reads `{"000012": "urban"}`; a kind is a word of letters, digits, `_` and `-`. Throws InputError
/// with every fault.
SceneKinds read_scene_kinds(const std::filesystem::path& file);

}  // namespace croon
