#include "framework/calibration/loaded_scene.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "framework/base/threads.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/pipeline/calibrate.hpp"

namespace croon {
namespace {

/// The faults without the path of the file: reasons must not depend on the data root.
std::string reasons(const InputError& error) {
  std::string text;
  for (const Fault& fault : error.faults()) {
    text += (text.empty() ? "" : "; ") + Fault{"", fault.where, fault.message}.line();
  }
  return text;
}

/// Reads the points of `scan`. Returns the reason why they are not usable, or an empty string.
/// Throws UnavailableFile.
std::string read_points(const SensorScan& scan, LoadedCloud& cloud) {
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

}  // namespace

ReadScan read_scan(const SensorScan& scan) {
  const auto start = std::chrono::steady_clock::now();
  ReadScan read;
  try {
    const std::string why_not = read_points(scan, read.cloud);
    if (!why_not.empty()) read.failure = "the cloud of " + scan.sensor + ": " + why_not;
  } catch (const UnavailableFile& error) {
    read.unavailable = error.faults().front();
    return read;
  }
  read.reading_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return read;
}

LoadedScan loaded_scan(ReadScan read, const std::string& scene, const std::string& sensor,
                       std::uint64_t seed, const std::set<std::string>& channels) {
  const auto start = std::chrono::steady_clock::now();
  LoadedScan loaded{nullptr, std::move(read.failure), std::move(read.unavailable), read.reading_s};
  if (!loaded.failure.empty() || loaded.unavailable) return loaded;
  // Other channels would be copied with each filtered cloud without being used.
  keep_channels(read.cloud, channels);
  loaded.cloud = std::make_shared<const Cloud>(static_cast<PointCloud&&>(std::move(read.cloud)),
                                               cloud_stream(seed, scene, sensor));
  loaded.reading_s +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return loaded;
}

LoadedScene load_scene(const Scene& scene, const std::set<std::string>& sensors, std::uint64_t seed,
                       const std::set<std::string>& channels) {
  LoadedScene loaded{&scene, std::vector<LoadedScan>(scene.sensors.size() + 1)};
  for_each_in_parallel(loaded.scans.size(), [&](std::size_t i) {
    const SensorScan& scan = scan_at(scene, i);
    if (i > 0 && sensors.count(scan.sensor) == 0) return;
    // Isolated like trials, so that the measured time is that of reading alone.
    tbb::this_task_arena::isolate([&] {
      loaded.scans[i] = loaded_scan(read_scan(scan), scene.name, scan.sensor, seed, channels);
    });
  });
  return loaded;
}

std::vector<std::string> sensor_names(const std::vector<Scene>& scenes) {
  std::vector<std::string> names;
  for (const Scene& scene : scenes) {
    for (const SensorScan& scan : scene.sensors) {
      if (std::find(names.begin(), names.end(), scan.sensor) == names.end()) {
        names.push_back(scan.sensor);
      }
    }
  }
  return names;
}

std::size_t index_of(const Scene& scene, const std::string& sensor) {
  const auto is_it = [&](const SensorScan& scan) { return scan.sensor == sensor; };
  const auto found = std::find_if(scene.sensors.begin(), scene.sensors.end(), is_it);
  return static_cast<std::size_t>(found - scene.sensors.begin());
}

const SensorScan& scan_at(const Scene& scene, std::size_t i) {
  return i == 0 ? scene.reference : scene.sensors[i - 1];
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

}  // namespace croon
