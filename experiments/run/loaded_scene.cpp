#include "experiments/run/loaded_scene.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>

#include "experiments/run/sensor_pairs.hpp"
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

/// Whether the cloud of each of Scene::sensors is needed for `sensors`.
std::vector<bool> needed_clouds(const Scene& scene, const std::set<std::string>& sensors) {
  std::vector<bool> is_needed(scene.sensors.size(), false);
  for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
    const SensorScan& scan = scene.sensors[i];
    if (sensors.count(scan.sensor) == 0) continue;
    if (is_pair(scan)) {
      is_needed[index_of(scene, scan.source)] = is_needed[index_of(scene, scan.target)] = true;
    } else {
      is_needed[i] = true;
    }
  }
  return is_needed;
}

void add_scan_timings(std::vector<TimingRow>& rows, const std::string& scene,
                      const std::string& sensor, const LoadedScan& scan) {
  if (!scan.cloud) return;
  const TrialId once{"", scene, sensor, -1};
  rows.push_back({once, "reading", scan.reading_s});
  for (const OnceTiming& timing : scan.cloud->timings()) {
    rows.push_back({once, timing.what, timing.seconds});
  }
}

}  // namespace

std::size_t index_of(const Scene& scene, const std::string& sensor) {
  const auto is_it = [&](const SensorScan& scan) { return scan.sensor == sensor; };
  const auto found = std::find_if(scene.sensors.begin(), scene.sensors.end(), is_it);
  return static_cast<std::size_t>(found - scene.sensors.begin());
}

LoadedScene load_scene(const Scene& scene, const std::set<std::string>& sensors, std::uint64_t seed,
                       const std::set<std::string>& channels) {
  const std::vector<bool> is_needed = needed_clouds(scene, sensors);
  LoadedScene loaded;
  loaded.scene = &scene;
  loaded.sensors.resize(scene.sensors.size());
  for_each_in_parallel(scene.sensors.size() + 1, [&](std::size_t i) {
    const bool is_reference = i == scene.sensors.size();
    if (!is_reference && !is_needed[i]) return;
    const SensorScan& scan = is_reference ? scene.reference : scene.sensors[i];
    LoadedScan& to = is_reference ? loaded.reference : loaded.sensors[i];
    // Isolated as trials are, so that the time of reading is its own.
    tbb::this_task_arena::isolate([&] { to = load_scan(scan, scene.name, seed, channels); });
  });
  return loaded;
}

CloudPair cloud_pair(const LoadedScene& loaded, std::size_t sensor) {
  const Scene& scene = *loaded.scene;
  const SensorScan& scan = scene.sensors[sensor];
  if (!is_pair(scan)) {
    return {scene.reference.sensor, scan.sensor, &loaded.reference, &loaded.sensors[sensor]};
  }
  return {scan.target, scan.source, &loaded.sensors[index_of(scene, scan.target)],
          &loaded.sensors[index_of(scene, scan.source)]};
}

std::vector<Fault> unavailable_clouds(const LoadedScene& loaded) {
  std::vector<Fault> faults;
  if (loaded.reference.unavailable) faults.push_back(*loaded.reference.unavailable);
  for (const LoadedScan& scan : loaded.sensors) {
    if (scan.unavailable) faults.push_back(*scan.unavailable);
  }
  return faults;
}

std::vector<std::string> damaged_clouds(const LoadedScene& loaded) {
  std::vector<std::string> reasons;
  const auto add = [&](const LoadedScan& scan) {
    if (!scan.failure.empty())
      reasons.push_back("scene " + loaded.scene->name + ": " + scan.failure);
  };
  add(loaded.reference);
  for (const LoadedScan& scan : loaded.sensors) add(scan);
  return reasons;
}

std::vector<TimingRow> scene_timings(const LoadedScene& loaded) {
  const Scene& scene = *loaded.scene;
  std::vector<TimingRow> rows;
  add_scan_timings(rows, scene.name, scene.reference.sensor, loaded.reference);
  for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
    add_scan_timings(rows, scene.name, scene.sensors[i].sensor, loaded.sensors[i]);
  }
  return rows;
}

}  // namespace croon::experiments
