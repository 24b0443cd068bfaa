#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/run/sensor_pairs.hpp"

namespace croon::experiments {

/// One calibration in a trial: either of a sensor to the reference, named after the sensor, or of a
/// sensor to another one. The known poses are T_target_source.
struct CalibratedPair : SensorPair {
  std::optional<RigidTransform> truth, nominal, initial;
};

/// The scenes from which a trial calibrates one rig.
struct SceneGroup {
  /// The name of the only scene; for several, the first name and the number of others, "000003+4".
  std::string name;
  std::string kind;           ///< The common kind of all scenes, or "mixed".
  std::vector<Scene> scenes;  ///< In the order of the dataset; at least one.
  /// All pairs of any scene, with the poses of the first scene that has them.
  std::vector<CalibratedPair> pairs;
};

/// `scan` of `scene`, calibrated to the reference.
CalibratedPair to_reference(const Scene& scene, const SensorScan& scan);

/// The scenes of the experiment's dataset, which must have the same reference, in groups of
/// `scenes_per_trial`. The groups are drawn from the experiment's seed and the number of scenes
/// only, and ordered by their first scenes. No two groups share a scene, so their trials are
/// independent; remaining scenes are left out. If the experiment has `loops`, each sensor of a
/// scene is also calibrated to those before it: T_target_source = T_reference_target^-1
/// T_reference_source. Initial poses of recordings may differ between the scenes of a group: a
/// trial starts near that of the first. Throws InputError as dataset_scenes does; if there are
/// fewer scenes than a group needs; if the reference differs between scenes, or the true or nominal
/// pose of a sensor within a group, which then has no common rig; and if the name of a sensor could
/// be that of a pair.
std::vector<SceneGroup> scene_groups(const Experiment& experiment,
                                     const std::filesystem::path& data_root);

/// The same for scenes that have already been read.
std::vector<SceneGroup> scene_groups(const Experiment& experiment, std::vector<Scene> scenes);

}  // namespace croon::experiments
