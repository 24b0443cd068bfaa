#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"

namespace croon::experiments {

/// Stands between the two names in the name of a pair.
inline constexpr char kBetweenSensors = '>';

/// Two sensors of a rig, of which one is calibrated to the other instead of to the reference.
struct SensorPair {
  std::string name;    ///< "left>front", the sensor of its trials.
  std::string source;  ///< "left", whose pose is estimated.
  std::string target;  ///< "front", in whose frame.
};

/// The pair of the two sensors.
SensorPair sensor_pair(const std::string& source, const std::string& target);

/// The pair whose name is `name` and whose target is `target`.
SensorPair named_pair(const std::string& name, const std::string& target);

/// The scenes of the experiment's dataset. Throws InputError as Dataset::scenes and check_names; a
/// fault of the dataset without a file, at a pointer of its parameters, is one of the experiment's
/// file at /dataset.
std::vector<Scene> dataset_scenes(const Experiment& experiment,
                                  const std::filesystem::path& data_root);

/// Throws InputError if the name of a scene or a sensor cannot stand in tables, figures and paths:
/// it must be UTF-8 without control characters, and not begin with a sign or a dot. Spreadsheets
/// take a cell that begins with a sign for a formula. Nor must two sensors of a scene have one
/// name, or a sensor the name "all", which stands for all of them. `file` is named if a scan has no
/// file.
void check_names(const std::vector<Scene>& scenes, const std::string& file);

}  // namespace croon::experiments
