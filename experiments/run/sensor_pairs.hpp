#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"

namespace croon::experiments {

/// Separates the two names in the name of a pair.
inline constexpr char kBetweenSensors = '>';

/// Two sensors of a rig, one of which is calibrated to the other instead of to the reference.
struct SensorPair {
  std::string name;    ///< "left>front", used as the sensor of its trials.
  std::string source;  ///< "left", whose pose is estimated.
  std::string target;  ///< "front", in whose frame the pose is.
};

/// The pair of the two sensors.
SensorPair sensor_pair(const std::string& source, const std::string& target);

/// The pair with the name `name` and the target `target`.
SensorPair named_pair(const std::string& name, const std::string& target);

/// The scenes of the experiment's dataset. Throws InputError as Dataset::scenes and check_names do;
/// a fault of the dataset without a file, at a pointer of its parameters, becomes one of the
/// experiment file at /dataset.
std::vector<Scene> dataset_scenes(const Experiment& experiment,
                                  const std::filesystem::path& data_root);

/// Throws InputError if the name of a scene or sensor is unsuitable for tables, figures and paths:
/// it must be UTF-8 without control characters, and must not begin with a sign or a dot, because
/// spreadsheets interpret cells that begin with a sign as formulas. The sensors of a scene must
/// have different names, and none may be called "all", which means all sensors together. `file` is
/// named if a scan has no file.
void check_names(const std::vector<Scene>& scenes, const std::string& file);

}  // namespace croon::experiments
