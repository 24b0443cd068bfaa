#pragma once

#include <string>
#include <vector>

#include "framework/stage/dataset.hpp"

namespace croon {

/// How the clouds of several sensors become scenes.
struct RecordingOptions {
  std::string reference;         ///< A sensor, or the topic of one; empty: the first.
  double max_time_gap_s = 0.05;  ///< Clouds of one scene are at most this far apart.
  int max_scenes = 10;           ///< Of more scenes, this many are used, evenly spaced.
};

/// The scenes of a recording, with clouds on demand.
struct RecordedScenes {
  std::vector<Scene> scenes;
  std::vector<std::string> unused;  ///< Clouds and scenes that take no part, one sentence each.
};

/// The scenes in what a user names, each input as `PATH` or `NAME=PATH`:
/// - a file per sensor, which are one scene;
/// - a folder per sensor, paired by the names of the files or by the time stamps in them;
/// - one folder with a folder per sensor;
/// - one rosbag2, with the topics that the further inputs name; without any, all with clouds.
/// Sensors without a name are called after their file, folder or topic. Throws InputError if an
/// input is missing, is not a cloud, or does not fit the others; if two sensors have one name; or
/// if no scene has clouds of two sensors.
RecordedScenes recorded_scenes(const std::vector<std::string>& inputs,
                               const RecordingOptions& options);

}  // namespace croon
