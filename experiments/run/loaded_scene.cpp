#include "experiments/run/loaded_scene.hpp"

namespace croon::experiments {
namespace {

/// The index of the scan of `sensor` in LoadedScene::scans; the number of scans if there is none.
std::size_t scan_index(const Scene& scene, const std::string& sensor) {
  return scene.reference.sensor == sensor ? 0 : 1 + index_of(scene, sensor);
}

}  // namespace

std::optional<CloudPair> cloud_pair(const LoadedScene& loaded, const SensorPair& pair) {
  const std::size_t target = scan_index(*loaded.scene, pair.target);
  const std::size_t source = scan_index(*loaded.scene, pair.source);
  // Targets of a sensor are the sensors before it in the scene.
  if (source == loaded.scans.size() || target >= source) return std::nullopt;
  return CloudPair{&loaded.scans[target], &loaded.scans[source]};
}

std::vector<TimingRow> scene_timings(const LoadedScene& loaded) {
  std::vector<TimingRow> rows;
  for (std::size_t i = 0; i < loaded.scans.size(); ++i) {
    const LoadedScan& scan = loaded.scans[i];
    if (!scan.cloud) continue;
    const TrialId once{"", loaded.scene->name, scan_at(*loaded.scene, i).sensor, -1};
    rows.push_back({once, "reading", scan.reading_s});
    for (const OnceTiming& timing : scan.cloud->timings()) {
      rows.push_back({once, timing.what, timing.seconds});
    }
  }
  return rows;
}

}  // namespace croon::experiments
