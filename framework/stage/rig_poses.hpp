#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// `T_reference_sensor` by the sensor's name.
using RigPoses = std::map<std::string, RigidTransform>;

/// Reads the poses of a rig: `{"front": {"rotation_rpy_deg": [roll, pitch, yaw], "translation_m":
/// [x, y, z]}}` with `R = Rz(yaw) Ry(pitch) Rx(roll)`. Throws InputError with every fault.
RigPoses read_rig_poses(const std::filesystem::path& file);

}  // namespace croon
