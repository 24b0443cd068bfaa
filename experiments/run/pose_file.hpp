#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"

namespace croon::experiments {

/// The first line of a file of poses `T_reference_sensor`; each line after it is one pose. `croon
/// starts` writes this format.
inline constexpr const char* kStartHeader = "scene,sensor,trial,tx_m,ty_m,tz_m,qx,qy,qz,qw";

/// The first line of a file with one pose for all trials of a sensor in a scene.
inline constexpr const char* kPoseHeader = "scene,sensor,tx_m,ty_m,tz_m,qx,qy,qz,qw";

/// So many faults are shown; the others are counted.
inline constexpr std::size_t kShownFaults = 10;

/// A line of a file of poses.
struct PoseLine {
  std::string scene;
  std::string sensor;
  int trial = -1;  ///< -1 if the file has no column of trials.
  Start pose;
};

/// The scenes of a dataset and their sensors by name.
class DatasetNames {
 public:
  explicit DatasetNames(const std::vector<Scene>& scenes);

  /// Whether the dataset has the scene, and the scene the sensor.
  bool has(const std::string& scene, const std::string& sensor) const;

  /// Throws InputError, with the nearest name, unless `has`. Finding the nearest of many names
  /// takes long.
  void check(const std::string& scene, const std::string& sensor) const;

 private:
  std::vector<std::string> scenes_;
  std::map<std::string, std::vector<std::string>> sensors_;
};

/// Reads the file of poses `path` of the dataset with `names`, whose first line must be one of
/// `headers`, and calls `add` for each pose. Returns the SHA-256 of the file. Throws one InputError
/// with the first faults of the lines; an InputError of `add` is a fault of its line.
std::string read_pose_file(const std::filesystem::path& path,
                           const std::vector<std::string>& headers, const DatasetNames& names,
                           const std::function<void(const PoseLine&)>& add);

/// Throws the first of `faults` of `file`, and how many more there are; `more` are not in the list.
[[noreturn]] void throw_first(std::vector<Fault> faults, const std::string& file,
                              std::size_t more = 0);

/// The file that `experiment` names as `name`, below `data_root`, else below the folder of the
/// experiment. Throws InputError at the file and position of `at` if there is none, or if the path
/// with its links leaves the folder; `what` is "a file of starts".
std::filesystem::path found_input(const Experiment& experiment, const std::string& name,
                                  const std::filesystem::path& data_root, const Fault& at,
                                  const std::string& what);

}  // namespace croon::experiments
