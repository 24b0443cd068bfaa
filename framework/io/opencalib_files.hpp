#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// The cloud of one device in a recording of the paper's authors (`lidar_cloud_path.txt`).
struct ListedCloud {
  int device_id = 0;
  std::string path;   ///< As in the file.
  std::string place;  ///< "line 4", for errors.
  /// The sensor's name; if empty when written, it follows from the file name.
  std::string sensor = {};
};

/// The default name of a sensor: its file name up to the first hyphen, "left" for
/// "left-2022-02-15.pcd".
std::string sensor_name_of_file(const std::string& path);

/// The initial pose of one device in a recording of the paper's authors (`initial_extrinsic.txt`).
struct ListedPose {
  int device_id = 0;
  RigidTransform T_reference_sensor;
  std::string place;
  std::string sensor = {};  ///< From a comment after the device number; empty without one.
  std::string note = {};    ///< From a comment after the pose.
};

/// Reads pairs of lines `device_id: 1` and `path: FILE`, in either order, and after the first of
/// them an optional line `sensor: NAME`; blank lines, blanks and Windows line endings are ignored.
/// Returns them sorted by device. Throws InputError with every faulty line.
std::vector<ListedCloud> read_cloud_list(const std::filesystem::path& file);

/// The same for `device_id: 1` and `(Roll,Pitch,Yaw,tx,ty,tz): R P Y X Y Z`, degrees and metres,
/// `R = Rz(yaw) Ry(pitch) Rx(roll)`. Either line may end in a comment, `# NAME`: the authors'
/// program reads the numbers only.
std::vector<ListedPose> read_pose_list(const std::filesystem::path& file);

/// The text of such files. Places are not written, and sensor names only if they differ from the
/// default.
std::string cloud_list_text(const std::vector<ListedCloud>& clouds);
std::string pose_list_text(const std::vector<ListedPose>& poses);

}  // namespace croon
