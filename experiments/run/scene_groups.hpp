#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/run/sensor_pairs.hpp"

namespace croon::experiments {

/// What a trial calibrates: a sensor to the reference, under the sensor's name, or a sensor to
/// another one; with the poses T_target_source that are known.
struct CalibratedPair : SensorPair {
  std::optional<RigidTransform> truth, nominal, initial;
};

/// The scenes from which a trial calibrates one rig.
struct SceneGroup {
  /// The name of the only scene; of several the first one's and the number of others, "000003+4".
  std::string name;
  std::string kind;           ///< That of all scenes, else "mixed".
  std::vector<Scene> scenes;  ///< In the order of the dataset; at least one.
  /// All that some scene has, with the poses of the first one that has it.
  std::vector<CalibratedPair> pairs;
};

/// `scan` of `scene`, calibrated to the reference.
CalibratedPair to_reference(const Scene& scene, const SensorScan& scan);

/// The scenes of the experiment's dataset, which have one reference, in groups of
/// `scenes_per_trial`: drawn from the experiment's seed and the number of scenes alone, in the
/// order of their first scenes. No two groups share a scene, so their trials are independent;
/// scenes that fill no group are left out. If the experiment has `loops`, each sensor of a scene is
/// also calibrated to those before it: T_target_source = T_reference_target^-1 T_reference_source.
/// The initial poses of recordings may differ between the scenes of a group: a trial starts near
/// that of the first. Throws InputError as dataset_scenes; if there are fewer scenes than a group
/// has; if the reference differs between scenes, or the true or nominal pose of a sensor within a
/// group, which then has no common rig; and if the name of a sensor could be that of a pair.
std::vector<SceneGroup> scene_groups(const Experiment& experiment,
                                     const std::filesystem::path& data_root);

/// The same of the scenes of a dataset that were read before.
std::vector<SceneGroup> scene_groups(const Experiment& experiment, std::vector<Scene> scenes);

}  // namespace croon::experiments
