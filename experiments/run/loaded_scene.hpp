#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/run/sensor_pairs.hpp"
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

/// The clouds of a scene: of the reference and, in the order of Scene::sensors, of the others.
/// Those that were not asked for are empty.
struct LoadedScene {
  const Scene* scene = nullptr;
  std::vector<LoadedScan> scans;
};

/// Reads the clouds of the reference and of the `sensors` of `scene`, in parallel, with the
/// channels `channels` of them. Their random streams are named by `seed`, scene and sensor. `scene`
/// must outlive the result.
LoadedScene load_scene(const Scene& scene, const std::set<std::string>& sensors, std::uint64_t seed,
                       const std::set<std::string>& channels);

/// The clouds of `pair`; std::nullopt if the scene does not have the pair.
struct CloudPair {
  const LoadedScan* target = nullptr;
  const LoadedScan* source = nullptr;
};
std::optional<CloudPair> cloud_pair(const LoadedScene& loaded, const SensorPair& pair);

/// The reasons for which clouds of the scene cannot be read now.
std::vector<Fault> unavailable_clouds(const LoadedScene& loaded);

/// What is wrong with clouds of the scene that are damaged or empty, with the scene's name.
std::vector<std::string> damaged_clouds(const LoadedScene& loaded);

/// The times of what was done once for the clouds.
std::vector<TimingRow> scene_timings(const LoadedScene& loaded);

}  // namespace croon::experiments
