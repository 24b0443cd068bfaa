#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// The cloud of one device in a recording of the paper's authors (`lidar_cloud_path.txt`).
struct ListedCloud {
  int device_id = 0;
  std::string path;         ///< As it is written.
  std::string place;        ///< "line 4", for errors.
  std::string sensor = {};  ///< The sensor's name; empty for that of the file when it is written.
};

/// "left" of "left-2022-02-15.pcd": the name of a sensor to which a list gives none is its file's
/// name up to the first hyphen.
std::string sensor_name_of_file(const std::string& path);

/// The start of one device in a recording of the paper's authors (`initial_extrinsic.txt`).
struct ListedPose {
  int device_id = 0;
  RigidTransform T_reference_sensor;
  std::string place;
  std::string sensor = {};  ///< From a comment behind the device's number; empty without one.
  std::string note = {};    ///< From a comment behind the pose.
};

/// Reads pairs of lines `device_id: 1` and `path: FILE`, in either order, and after the first of
/// them an optional line `sensor: NAME`; blank lines, blanks and Windows' ends of line do not
/// matter. Sorted by device. Throws InputError with every faulty line.
std::vector<ListedCloud> read_cloud_list(const std::filesystem::path& file);

/// The same for `device_id: 1` and `(Roll,Pitch,Yaw,tx,ty,tz): R P Y X Y Z`, degrees and metres,
/// `R = Rz(yaw) Ry(pitch) Rx(roll)`. Either line may end in a comment, `# NAME`: the authors'
/// program reads the numbers only.
std::vector<ListedPose> read_pose_list(const std::filesystem::path& file);

/// The bytes of such files. Places are not written, and names of sensors only if they are not those
/// of the files.
std::string cloud_list_text(const std::vector<ListedCloud>& clouds);
std::string pose_list_text(const std::vector<ListedPose>& poses);

}  // namespace croon
