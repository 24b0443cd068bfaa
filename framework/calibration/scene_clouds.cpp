#include "framework/calibration/scene_clouds.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "framework/base/threads.hpp"
#include "framework/spatial/scan_times.hpp"

namespace croon {
namespace {

std::string why_no_cloud(const ReadScan& scan) {
  return scan.unavailable ? scan.unavailable->line() : scan.failure;
}

bool has_usable_sensor(const SceneClouds& scene) {
  return std::any_of(scene.sensors.begin(), scene.sensors.end(),
                     [](const ReadScan& scan) { return scan.is_usable(); });
}

/// The names of copies among the scenes that are still in use.
std::set<std::string> copies_among(const std::vector<SceneClouds>& scenes) {
  const std::vector<std::string> copies = copied_scenes(named_clouds(scenes));
  return {copies.begin(), copies.end()};
}

/// Excludes each sensor whose cloud is a copy of the reference's or of an earlier sensor's: the
/// copy would agree perfectly with it and mislead the other sensors.
void set_aside_copies(SceneClouds& scene) {
  std::vector<std::pair<std::string, const LoadedCloud*>> originals = {
      {scene.scene->reference.sensor, &scene.reference.cloud}};
  for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
    ReadScan& scan = scene.sensors[i];
    if (!scan.is_usable()) continue;
    const std::string& sensor = scene.scene->sensors[i].sensor;
    const auto original = std::find_if(
        originals.begin(), originals.end(),
        [&](const auto& earlier) { return have_same_points(*earlier.second, scan.cloud); });
    if (original == originals.end()) {
      originals.emplace_back(sensor, &scan.cloud);
    } else {
      scan.failure = "the cloud of " + sensor + " is a copy of the cloud of " + original->first;
    }
  }
}

/// Why the times of one cloud are not usable; empty if they are.
std::string why_no_times(const std::string& sensor, const PointCloud& cloud) {
  const TimeCheck check = check_times(cloud);
  if (check.is_usable) return "";
  return "the cloud of " + sensor +
         (check.has_times ? " has unusable times: " + check.reason : " has no times");
}

/// Why the times in one scene are in doubt.
std::string doubt_in(const SceneClouds& scene) {
  std::vector<std::string> names = {scene.scene->reference.sensor};
  std::vector<const PointCloud*> clouds = {&scene.reference.cloud};
  for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
    if (!scene.sensors[i].is_usable()) continue;
    names.push_back(scene.scene->sensors[i].sensor);
    clouds.push_back(&scene.sensors[i].cloud);
  }
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    std::string why_not = why_no_times(names[i], *clouds[i]);
    if (!why_not.empty()) return why_not;
  }
  return why_not_one_clock(names, clouds);
}

std::string missing_channel(const std::string& pipeline, const std::string& sensor,
                            const PointCloud& cloud, const std::set<std::string>& channels) {
  for (const std::string& channel : channels) {
    if (find_channel(cloud, channel) != nullptr) continue;
    return "the pipeline \"" + pipeline + "\" needs the channel \"" + channel +
           "\", which the cloud of " + sensor + " does not have";
  }
  return "";
}

}  // namespace

std::vector<SceneClouds> read_scenes(const std::vector<Scene>& scenes,
                                     const std::function<void(const std::string& scene)>& on_read) {
  std::vector<SceneClouds> clouds(scenes.size());
  std::mutex mutex;
  for_each_in_parallel(scenes.size(), [&](std::size_t s) {
    const Scene& scene = scenes[s];
    clouds[s].scene = &scene;
    clouds[s].sensors.resize(scene.sensors.size());
    for_each_in_parallel(scene.sensors.size() + 1, [&](std::size_t i) {
      if (i == scene.sensors.size()) {
        clouds[s].reference = read_scan(scene.reference);
      } else {
        clouds[s].sensors[i] = read_scan(scene.sensors[i]);
      }
    });
    const std::lock_guard<std::mutex> lock(mutex);
    on_read(scene.name);
  });
  return clouds;
}

std::vector<std::string> set_aside_unusable(std::vector<SceneClouds>& scenes) {
  std::vector<std::string> unused;
  for (SceneClouds& scene : scenes) {
    const std::string where = "Scene " + scene.scene->name + ": ";
    if (!scene.reference.is_usable()) {
      scene.why_unused = why_no_cloud(scene.reference);
      unused.push_back(where + scene.why_unused + "; the scene is not used.");
      continue;
    }
    set_aside_copies(scene);
    for (const ReadScan& scan : scene.sensors) {
      if (!scan.is_usable()) unused.push_back(where + why_no_cloud(scan) + ".");
    }
    if (!has_usable_sensor(scene)) {
      scene.why_unused = "no cloud of a sensor other than the reference is usable";
      unused.push_back(where + scene.why_unused + ".");
    }
  }
  const std::set<std::string> copies = copies_among(scenes);
  for (SceneClouds& scene : scenes) {
    if (!scene.why_unused.empty() || copies.count(scene.scene->name) == 0) continue;
    scene.why_unused = "its clouds are copies of the clouds of an earlier scene";
    unused.push_back("Scene " + scene.scene->name + ": " + scene.why_unused +
                     "; it does not count as evidence.");
  }
  return unused;
}

std::vector<NamedCloud> named_clouds(const std::vector<SceneClouds>& scenes) {
  std::vector<NamedCloud> clouds;
  for (const SceneClouds& scene : scenes) {
    if (!scene.why_unused.empty()) continue;
    clouds.push_back({scene.scene->name, scene.scene->reference.sensor, &scene.reference.cloud});
    for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
      if (!scene.sensors[i].is_usable()) continue;
      clouds.push_back(
          {scene.scene->name, scene.scene->sensors[i].sensor, &scene.sensors[i].cloud});
    }
  }
  return clouds;
}

std::string why_times_are_in_doubt(const std::vector<SceneClouds>& scenes) {
  for (const SceneClouds& scene : scenes) {
    if (!scene.why_unused.empty()) continue;
    const std::string doubt = doubt_in(scene);
    if (doubt.empty()) continue;
    return scenes.size() > 1 ? "in scene " + scene.scene->name + ", " + doubt : doubt;
  }
  return "";
}

std::string why_not_for(const Composition& composition, const SceneClouds& scene,
                        std::size_t sensor) {
  const std::string& reference = scene.scene->reference.sensor;
  const std::string& name = scene.scene->sensors[sensor].sensor;
  const PointCloud& target = scene.reference.cloud;
  const PointCloud& source = scene.sensors[sensor].cloud;
  const std::string missing =
      missing_channel(composition.name, reference, target, composition.target_channels);
  if (!missing.empty()) return missing;
  std::string why_not =
      missing_channel(composition.name, name, source, composition.source_channels);
  if (!why_not.empty() || composition.source_channels.count(kTime) == 0) return why_not;
  why_not = why_no_times(reference, target);
  if (why_not.empty()) why_not = why_no_times(name, source);
  return why_not.empty() ? why_not_one_clock({reference, name}, {&target, &source}) : why_not;
}

}  // namespace croon
