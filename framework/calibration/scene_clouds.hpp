#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "framework/calibration/composition.hpp"
#include "framework/calibration/loaded_scene.hpp"
#include "framework/calibration/warnings.hpp"

namespace croon {

/// The clouds of one scene as in their files.
struct SceneClouds {
  const Scene* scene = nullptr;
  ReadScan reference;
  std::vector<ReadScan> sensors;  ///< In the order of Scene::sensors.
  std::string why_unused = {};    ///< Why no cloud of the scene is used; empty if some are.
};

/// Reads the clouds of all scenes in parallel. `scenes` must outlive the result; `on_read` is
/// called once per scene, by one thread at a time.
std::vector<SceneClouds> read_scenes(const std::vector<Scene>& scenes,
                                     const std::function<void(const std::string& scene)>& on_read);

/// Sets SceneClouds::why_unused of scenes without a usable cloud of the reference or of another
/// sensor, and of copies of earlier scenes. Returns the reasons why scenes and single clouds are
/// not used, one sentence each.
std::vector<std::string> set_aside_unusable(std::vector<SceneClouds>& scenes);

/// The usable clouds of the scenes in use, for warnings.
std::vector<NamedCloud> named_clouds(const std::vector<SceneClouds>& scenes);

/// Why times of usable clouds are in doubt, in the first scene with any doubt; empty if none is.
std::string why_times_are_in_doubt(const std::vector<SceneClouds>& scenes);

/// Why `composition` cannot use the cloud of a sensor in its scene, because of missing channels or
/// unusable times; empty if it can. `sensor` is an index into Scene::sensors.
std::string why_not_for(const Composition& composition, const SceneClouds& scene,
                        std::size_t sensor);

}  // namespace croon
