#include "experiments/run/sensor_pairs.hpp"

#include <algorithm>

namespace croon::experiments {
namespace {

constexpr char kBetween = '>';

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
  pair.measure = {};
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

}  // namespace

bool is_pair(const SensorScan& scan) { return !scan.target.empty(); }

SensorPair sensor_pair(const std::string& source, const std::string& target) {
  return {source + kBetween + target, source, target};
}

SensorPair named_pair(const std::string& name, const std::string& target) {
  return {name, name.substr(0, name.size() - target.size() - 1), target};
}

std::vector<Scene> scenes_of(const Experiment& experiment, const std::filesystem::path& data_root) {
  std::vector<Scene> scenes = experiment.dataset->scenes(data_root);
  if (experiment.loops) {
    for (Scene& scene : scenes) add_pairs(scene);
  }
  return scenes;
}

std::vector<Scene> without_pairs(std::vector<Scene> scenes) {
  for (Scene& scene : scenes) {
    const auto first = std::find_if(scene.sensors.begin(), scene.sensors.end(), is_pair);
    scene.sensors.erase(first, scene.sensors.end());
  }
  return scenes;
}

}  // namespace croon::experiments
