#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/run/trial_record.hpp"
#include "framework/base/error.hpp"
#include "framework/spatial/cloud.hpp"
#include "framework/stage/dataset.hpp"

namespace croon::experiments {

/// One sensor's cloud, or why it has none.
struct LoadedScan {
  std::shared_ptr<const Cloud> cloud;
  std::string failure;                    ///< The cloud is damaged or empty.
  std::optional<Fault> unavailable = {};  ///< It cannot be read now.
  double reading_s = 0.0;
};

/// The clouds of a scene. Those that were not asked for are empty, as are pairs of sensors.
struct LoadedScene {
  const Scene* scene = nullptr;
  LoadedScan reference;
  std::vector<LoadedScan> sensors;  ///< As Scene::sensors.
};

/// Reads the clouds of `scene`, in parallel, that the sensors and pairs with the names `sensors`
/// are calibrated from, with the channels `channels` of them. Their random streams are named by
/// `seed`, scene and sensor. `scene` must outlive the result.
LoadedScene load_scene(const Scene& scene, const std::set<std::string>& sensors, std::uint64_t seed,
                       const std::set<std::string>& channels);

/// The index of `sensor` in Scene::sensors; their number if the scene does not have it.
std::size_t index_of(const Scene& scene, const std::string& sensor);

/// The names and the clouds of what is calibrated to what: `sensor` is an index in Scene::sensors.
struct CloudPair {
  std::string target;  ///< The reference, or the one sensor of a pair.
  std::string source;  ///< The sensor whose pose is estimated.
  const LoadedScan* target_scan = nullptr;
  const LoadedScan* source_scan = nullptr;
};
CloudPair cloud_pair(const LoadedScene& loaded, std::size_t sensor);

/// The reasons for which clouds of the scene cannot be read now.
std::vector<Fault> unavailable_clouds(const LoadedScene& loaded);

/// What is wrong with clouds of the scene that are damaged or empty, with the scene's name.
std::vector<std::string> damaged_clouds(const LoadedScene& loaded);

/// The times of what was done once for the clouds.
std::vector<TimingRow> scene_timings(const LoadedScene& loaded);

}  // namespace croon::experiments
