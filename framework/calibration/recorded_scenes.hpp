#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/stage/dataset.hpp"

namespace croon {

/// How the clouds of several sensors are combined into scenes.
struct RecordingOptions {
  std::string reference;         ///< The name or topic of a sensor; empty: the first one.
  double max_time_gap_s = 0.05;  ///< Maximum time between clouds of one scene.
  int max_scenes = 10;           ///< Maximum number of scenes that are used, evenly spaced.
};

/// The scenes of a recording, whose clouds are read on demand.
struct RecordedScenes {
  std::vector<Scene> scenes;
  std::vector<std::string> unused;  ///< Clouds and scenes that are not used, one sentence each.
};

/// The scan of `sensor` in `file`, which is read on demand.
SensorScan scan_on_demand(const std::string& sensor, const std::filesystem::path& file);

/// The scenes in a user's inputs, each `PATH` or `NAME=PATH`:
/// - a file per sensor, which form one scene;
/// - a folder per sensor, paired by the names of the files or by the time stamps in them;
/// - one folder with a folder per sensor;
/// - one rosbag2, followed by its topics; without topics, all with clouds. Sensors without a name
/// are named after their file, folder or topic. Throws InputError if an input is missing, is not a
/// cloud, or does not fit the others; if two sensors have the same name; or if no scene has clouds
/// of two sensors.
RecordedScenes recorded_scenes(const std::vector<std::string>& inputs,
                               const RecordingOptions& options);

}  // namespace croon
