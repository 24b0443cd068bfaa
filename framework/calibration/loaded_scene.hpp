#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/spatial/cloud.hpp"
#include "framework/stage/dataset.hpp"

namespace croon {

/// One sensor's cloud as in its file, or why it cannot be used.
struct ReadScan {
  LoadedCloud cloud;
  std::string failure;                    ///< Set if the cloud is damaged or empty.
  std::optional<Fault> unavailable = {};  ///< Set if it cannot be read at present.
  double reading_s = 0.0;

  bool is_usable() const { return failure.empty() && !unavailable; }
};

/// Reads the cloud of `scan`.
ReadScan read_scan(const SensorScan& scan);

/// One sensor's cloud for the steps of a pipeline, or why there is none.
struct LoadedScan {
  std::shared_ptr<const Cloud> cloud;
  std::string failure;                    ///< Set if the cloud is damaged or empty.
  std::optional<Fault> unavailable = {};  ///< Set if it cannot be read at present.
  double reading_s = 0.0;
};

/// The clouds of a scene: the reference's, then the others' in the order of Scene::sensors. Clouds
/// that were not requested are empty.
struct LoadedScene {
  const Scene* scene = nullptr;
  std::vector<LoadedScan> scans;
};

/// The scan `read` of `sensor` with only the channels `channels`. The random streams of its cloud
/// depend on `seed`, scene and sensor.
LoadedScan loaded_scan(ReadScan read, const std::string& scene, const std::string& sensor,
                       std::uint64_t seed, const std::set<std::string>& channels);

/// Reads the clouds of the reference of `scene` and of its sensors in `sensors`, in parallel.
/// `scene` must outlive the result.
LoadedScene load_scene(const Scene& scene, const std::set<std::string>& sensors, std::uint64_t seed,
                       const std::set<std::string>& channels);

/// The distinct names of the sensors other than the reference, in the order of the scenes.
std::vector<std::string> sensor_names(const std::vector<Scene>& scenes);

/// The index of `sensor` in Scene::sensors, or their number if the scene lacks it.
std::size_t index_of(const Scene& scene, const std::string& sensor);

/// The scan with the index `i` in LoadedScene::scans.
const SensorScan& scan_at(const Scene& scene, std::size_t i);

/// The reasons why clouds of the scene cannot be read at present.
std::vector<Fault> unavailable_clouds(const LoadedScene& loaded);

/// The faults of damaged or empty clouds of the scene, with the scene's name.
std::vector<std::string> damaged_clouds(const LoadedScene& loaded);

}  // namespace croon
