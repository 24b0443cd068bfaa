#include "experiments/run/sensor_pairs.hpp"

#include <set>

#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"
#include "framework/recording/recording.hpp"

namespace croon::experiments {
namespace {

void check_name(const std::string& what, const std::string& name, const std::string& file,
                std::vector<Fault>& faults) {
  const std::string why_not = why_no_scan_name(name, "a " + what);
  if (!why_not.empty()) faults.push_back({file, "", why_not});
}

/// Notes a fault for a name that has another meaning in tables, and for a duplicate name in
/// `scene`.
void check_meanings(const Scene& scene, const std::string& file, std::vector<Fault>& faults) {
  std::set<std::string> names = {scene.reference.sensor};
  for (const SensorScan& scan : scene.sensors) {
    const std::string& at = scan.file.empty() ? file : scan.file;
    if (scan.sensor == kAllSensors) {
      faults.push_back({file, "/dataset",
                        "expected a sensor name other than " + in_quotes(kAllSensors) +
                            ", which means all sensors together"});
    }
    if (names.insert(scan.sensor).second) continue;
    faults.push_back({at, "",
                      "expected sensors with different names in scene " + in_quotes(scene.name) +
                          ", found " + in_quotes(scan.sensor) + " twice"});
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

}  // namespace croon::experiments
