#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/run/given_csv.hpp"
#include "experiments/run/scene_groups.hpp"

namespace croon::experiments {

/// The header of a file of poses `T_reference_sensor`; each further line is one pose. `croon
/// starts` writes this format.
inline constexpr const char* kStartHeader = "scene,sensor,trial,tx_m,ty_m,tz_m,qx,qy,qz,qw";

/// The header of a file with one pose per scene and sensor for all trials.
inline constexpr const char* kPoseHeader = "scene,sensor,tx_m,ty_m,tz_m,qx,qy,qz,qw";

/// A line of a file of poses.
struct PoseLine {
  std::string scene;
  std::string sensor;
  int trial = -1;  ///< -1 if the file has no column of trials.
  Start pose;
};

/// The names of the scenes or groups of a dataset and of the sensors or pairs calibrated in them.
class DatasetNames {
 public:
  explicit DatasetNames(const std::vector<SceneGroup>& groups);

  /// Whether the dataset has the scene, and the scene has the sensor.
  bool has(const std::string& scene, const std::string& sensor) const;

  /// Throws InputError, which suggests the nearest name, if `has` is false. Finding the nearest of
  /// many names is slow.
  void check(const std::string& scene, const std::string& sensor) const;

 private:
  std::vector<std::string> scenes_;
  std::map<std::string, std::vector<std::string>> sensors_;
};

/// Reads the file of poses `path` of the dataset with `names`, whose first line must be one of
/// `headers`, and calls `add` for each pose. Returns the SHA-256 of the file. Throws one InputError
/// with the first faults of the lines; an InputError thrown by `add` is a fault of its line.
std::string read_pose_file(const std::filesystem::path& path,
                           const std::vector<std::string>& headers, const DatasetNames& names,
                           const std::function<void(const PoseLine&)>& add);

}  // namespace croon::experiments
