#include "experiments/run/loaded_scene.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>

#include "framework/base/threads.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/pipeline/calibrate.hpp"

namespace croon::experiments {
namespace {

/// The faults without the file's path: a reason must not depend on the data root.
std::string reasons(const InputError& error) {
  std::string text;
  for (const Fault& fault : error.faults()) {
    text += (text.empty() ? "" : "; ") + Fault{"", fault.where, fault.message}.line();
  }
  return text;
}

/// Reads the points of `scan`. Returns what is wrong with them, or an empty string. Throws
/// UnavailableFile.
std::string read_points(const SensorScan& scan, PointCloud& cloud) {
  try {
    cloud = scan.load();
  } catch (const UnavailableFile&) {
    throw;
  } catch (const InputError& error) {
    return reasons(error);
  }
  const auto is_finite_point = [](const Eigen::Vector3f& point) { return point.allFinite(); };
  return std::any_of(cloud.points.begin(), cloud.points.end(), is_finite_point)
             ? ""
             : "it has no points";
}

LoadedScan load_scan(const SensorScan& scan, const std::string& scene, std::uint64_t seed,
                     const std::set<std::string>& channels) {
  const auto start = std::chrono::steady_clock::now();
  LoadedScan loaded;
  PointCloud points;
  std::string why_not;
  try {
    why_not = read_points(scan, points);
  } catch (const UnavailableFile& error) {
    loaded.unavailable = error.faults().front();
    return loaded;
  }
  if (why_not.empty()) {
    // Others would be copied with each filtered cloud, and nothing would read them.
    keep_channels(points, channels);
    loaded.cloud =
        std::make_shared<const Cloud>(std::move(points), cloud_stream(seed, scene, scan.sensor));
  } else {
    loaded.failure = "the cloud of " + scan.sensor + ": " + why_not;
  }
  loaded.reading_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return loaded;
}

/// The scan with the index `i` in LoadedScene::scans.
const SensorScan& scan_at(const Scene& scene, std::size_t i) {
  return i == 0 ? scene.reference : scene.sensors[i - 1];
}

/// The index of the scan of `sensor` in LoadedScene::scans; their number if there is none.
std::size_t index_of(const LoadedScene& loaded, const std::string& sensor) {
  std::size_t i = 0;
  while (i < loaded.scans.size() && scan_at(*loaded.scene, i).sensor != sensor) ++i;
  return i;
}

}  // namespace

LoadedScene load_scene(const Scene& scene, const std::set<std::string>& sensors, std::uint64_t seed,
                       const std::set<std::string>& channels) {
  LoadedScene loaded{&scene, std::vector<LoadedScan>(scene.sensors.size() + 1)};
  for_each_in_parallel(loaded.scans.size(), [&](std::size_t i) {
    const SensorScan& scan = scan_at(scene, i);
    if (i > 0 && sensors.count(scan.sensor) == 0) return;
    // Isolated as trials are, so that the time of reading is its own.
    tbb::this_task_arena::isolate(
        [&] { loaded.scans[i] = load_scan(scan, scene.name, seed, channels); });
  });
  return loaded;
}

std::optional<CloudPair> cloud_pair(const LoadedScene& loaded, const SensorPair& pair) {
  const std::size_t target = index_of(loaded, pair.target);
  const std::size_t source = index_of(loaded, pair.source);
  // A sensor is calibrated to those before it, in the order of the scene.
  if (source == loaded.scans.size() || target >= source) return std::nullopt;
  return CloudPair{&loaded.scans[target], &loaded.scans[source]};
}

std::vector<Fault> unavailable_clouds(const LoadedScene& loaded) {
  std::vector<Fault> faults;
  for (const LoadedScan& scan : loaded.scans) {
    if (scan.unavailable) faults.push_back(*scan.unavailable);
  }
  return faults;
}

std::vector<std::string> damaged_clouds(const LoadedScene& loaded) {
  std::vector<std::string> reasons;
  for (const LoadedScan& scan : loaded.scans) {
    if (scan.failure.empty()) continue;
    reasons.push_back("scene " + loaded.scene->name + ": " + scan.failure);
  }
  return reasons;
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
