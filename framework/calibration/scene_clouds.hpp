#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "framework/calibration/composition.hpp"
#include "framework/calibration/loaded_scene.hpp"
#include "framework/calibration/warnings.hpp"

namespace croon {

/// The clouds of one scene as their files have them.
struct SceneClouds {
  const Scene* scene = nullptr;
  ReadScan reference;
  std::vector<ReadScan> sensors;  ///< As Scene::sensors.
  std::string why_unused = {};    ///< Why no cloud of the scene takes part; empty if some do.
};

/// Reads the clouds of all scenes in parallel. `scenes` must outlive the result; `on_read` is
/// called once per scene, by one thread at a time.
std::vector<SceneClouds> read_scenes(const std::vector<Scene>& scenes,
                                     const std::function<void(const std::string& scene)>& on_read);

/// Notes in SceneClouds::why_unused which scenes cannot be used: without a usable cloud of the
/// reference or of another sensor, and copies of earlier scenes. Returns the reasons for which
/// scenes and single clouds take no part, one sentence each.
std::vector<std::string> set_aside_unusable(std::vector<SceneClouds>& scenes);

/// The usable clouds of the scenes that take part, for warnings.
std::vector<NamedCloud> named_clouds(const std::vector<SceneClouds>& scenes);

/// Why times cannot be used to correct motion; empty if they can.
struct TimesInDoubt {
  std::string reason;  ///< "the cloud of left in scene 0001 has no times".
  /// Each cloud has usable times, but those of different sensors are not of one clock or moment.
  bool are_clocks_apart = false;
};

/// The doubt about the times of the usable clouds in the first scene with clocks that are apart,
/// else in the first scene with any.
TimesInDoubt times_in_doubt(const std::vector<SceneClouds>& scenes);

/// Why `composition` cannot use the cloud of a sensor in its scene, of which it needs channels;
/// empty if it can. `sensor` is an index in Scene::sensors.
std::string why_not_for(const Composition& composition, const SceneClouds& scene,
                        std::size_t sensor);

}  // namespace croon
