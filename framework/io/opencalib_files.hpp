#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// The cloud of one device in a recording of the paper's authors (`lidar_cloud_path.txt`).
struct ListedCloud {
  int device_id = 0;
  std::string path;   ///< As it is written.
  std::string place;  ///< "line 4", for errors.
};

/// The start of one device in a recording of the paper's authors (`initial_extrinsic.txt`).
struct ListedPose {
  int device_id = 0;
  RigidTransform T_reference_sensor;
  std::string place;
};

/// Reads pairs of lines `device_id: 1` and `path: FILE`, in either order; blank lines, blanks and
/// Windows' ends of line do not matter. Sorted by device. Throws InputError with every faulty line.
std::vector<ListedCloud> read_cloud_list(const std::filesystem::path& file);

/// The same for `device_id: 1` and `(Roll,Pitch,Yaw,tx,ty,tz): R P Y X Y Z`, degrees and metres,
/// `R = Rz(yaw) Ry(pitch) Rx(roll)`.
std::vector<ListedPose> read_pose_list(const std::filesystem::path& file);

/// The bytes of such files. Places are not written.
std::string cloud_list_text(const std::vector<ListedCloud>& clouds);
std::string pose_list_text(const std::vector<ListedPose>& poses);

}  // namespace croon
