#include "experiments/run/sensor_pairs.hpp"

#include <algorithm>
#include <set>

#include "experiments/run/scene_groups.hpp"
#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"
#include "framework/recording/recording.hpp"

namespace croon::experiments {
namespace {

std::optional<RigidTransform> between(const std::optional<RigidTransform>& T_reference_target,
                                      const std::optional<RigidTransform>& T_reference_source) {
  if (!T_reference_target || !T_reference_source) return std::nullopt;
  return T_reference_target->inverse() * *T_reference_source;
}

SensorScan pair_scan(const SensorScan& source, const SensorScan& target) {
  SensorScan pair = source;
  pair.sensor = sensor_pair(source.sensor, target.sensor).name;
  pair.source = source.sensor;
  pair.target = target.sensor;
  pair.truth = between(target.truth, source.truth);
  pair.nominal = between(target.nominal, source.nominal);
  pair.initial = between(target.initial, source.initial);
  return pair;
}

void add_pairs(Scene& scene) {
  const std::vector<SensorScan> sensors = scene.sensors;
  for (std::size_t target = 0; target < sensors.size(); ++target) {
    for (std::size_t source = target + 1; source < sensors.size(); ++source) {
      scene.sensors.push_back(pair_scan(sensors[source], sensors[target]));
    }
  }
}

/// Throws InputError if the sensors of `scene` and their pairs are more than a store may have.
void check_number_of_pairs(const Scene& scene, const std::string& file) {
  const std::size_t sensors = scene.sensors.size();
  const std::size_t with_pairs = sensors + sensors * (sensors - 1) / 2;
  if (sensors == 0 || with_pairs <= kMostVariants) return;
  throw InputError(file, "/loops",
                   "expected at most " + std::to_string(kMostVariants) +
                       " sensors and pairs of them, found " + std::to_string(with_pairs) +
                       " in scene " + in_quotes(scene.name));
}

void check_name(const std::string& what, const std::string& name, const std::string& file,
                std::vector<Fault>& faults) {
  const std::string why_not = why_no_scan_name(name, "a " + what);
  if (!why_not.empty()) faults.push_back({file, "", why_not});
}

/// Notes a fault for a name that tables have for something else, and for one that `scene` has
/// twice.
void check_meanings(const Scene& scene, const std::string& file, std::vector<Fault>& faults) {
  std::set<std::string> names = {scene.reference.sensor};
  for (const SensorScan& scan : scene.sensors) {
    const std::string& at = scan.file.empty() ? file : scan.file;
    if (scan.sensor == kAllSensors) {
      faults.push_back({file, "/dataset",
                        "expected a sensor with another name than " + in_quotes(kAllSensors) +
                            ", which is that of all sensors together"});
    }
    if (names.insert(scan.sensor).second) continue;
    faults.push_back({at, "",
                      "expected sensors with different names in scene " + in_quotes(scene.name) +
                          ", found " + in_quotes(scan.sensor) + " twice"});
  }
}

/// Throws InputError if the name of a sensor could be that of a pair, or part of one.
void check_names_for_pairs(const std::vector<Scene>& scenes, const std::string& file) {
  std::vector<Fault> faults;
  std::set<std::string> checked;
  for (const Scene& scene : scenes) {
    for (const SensorScan& scan : scene.sensors) {
      if (scan.sensor.find(kBetweenSensors) == std::string::npos) continue;
      if (!checked.insert(scan.sensor).second) continue;
      faults.push_back({file, "/loops",
                        std::string("expected sensors without \"") + kBetweenSensors +
                            "\" in their names, which is that of pairs of sensors, found " +
                            in_quotes(scan.sensor)});
    }
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

/// Throws InputError if the scenes have different references: their poses are in different frames.
void require_one_reference(const Experiment& experiment, const std::vector<Scene>& scenes) {
  for (const Scene& scene : scenes) {
    const std::string& first = scenes.front().reference.sensor;
    if (scene.reference.sensor == first) continue;
    throw InputError(experiment.file, "/dataset",
                     "expected one reference in all scenes, found " + in_quotes(first) +
                         " in scene " + in_quotes(scenes.front().name) + " and " +
                         in_quotes(scene.reference.sensor) + " in " + in_quotes(scene.name));
  }
}

}  // namespace

void check_names(const std::vector<Scene>& scenes, const std::string& file) {
  std::vector<Fault> faults;
  for (const Scene& scene : scenes) {
    const auto check_sensor = [&](const SensorScan& scan) {
      check_name("sensor", scan.sensor, scan.file.empty() ? file : scan.file, faults);
    };
    const std::string& of_reference = scene.reference.file;
    check_name("scene", scene.name, of_reference.empty() ? file : of_reference, faults);
    check_sensor(scene.reference);
    for (const SensorScan& scan : scene.sensors) check_sensor(scan);
    check_meanings(scene, file, faults);
  }
  if (!faults.empty()) throw InputError(without_repeats(faults));
}

bool is_pair(const SensorScan& scan) { return !scan.target.empty(); }

SensorPair sensor_pair(const std::string& source, const std::string& target) {
  return {source + kBetweenSensors + target, source, target};
}

SensorPair named_pair(const std::string& name, const std::string& target) {
  return {name, name.substr(0, name.size() - target.size() - 1), target};
}

std::vector<Scene> dataset_scenes(const Experiment& experiment,
                                  const std::filesystem::path& data_root) {
  try {
    std::vector<Scene> scenes = experiment.dataset->scenes(data_root);
    check_names(scenes, experiment.file);
    return scenes;
  } catch (const InputError& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults) {
      if (!fault.file.empty() || fault.where.empty()) continue;
      fault.file = experiment.file;
      fault.where = "/dataset" + fault.where;
    }
    throw InputError(std::move(faults));
  }
}

std::vector<Scene> scenes_of(const Experiment& experiment, const std::filesystem::path& data_root) {
  std::vector<Scene> scenes = dataset_scenes(experiment, data_root);
  require_one_reference(experiment, scenes);
  if (experiment.loops) {
    check_names_for_pairs(scenes, experiment.file);
    for (Scene& scene : scenes) {
      check_number_of_pairs(scene, experiment.file);
      add_pairs(scene);
    }
  }
  return grouped(experiment, std::move(scenes));
}

std::vector<Scene> without_pairs(std::vector<Scene> scenes) {
  for (Scene& scene : scenes) {
    // In a group, sensors that its first scene lacks stand behind pairs.
    std::vector<SensorScan>& scans = scene.sensors;
    scans.erase(std::remove_if(scans.begin(), scans.end(), is_pair), scans.end());
    scene.parts = without_pairs(std::move(scene.parts));
  }
  return scenes;
}

}  // namespace croon::experiments
