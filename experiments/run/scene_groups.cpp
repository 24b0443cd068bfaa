#include "experiments/run/scene_groups.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/rng.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

/// Tolerance within which two poses of a rig are the same.
constexpr double kSamePose = 1e-9;

/// The indices below `count` in an order drawn with `seed`.
std::vector<std::size_t> drawn_order(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Rng rng(StreamKey(seed).with("groups"));
  for (std::size_t left = count; left > 1; --left) {
    std::swap(order[left - 1], order[rng.below(left)]);
  }
  return order;
}

/// The groups, each a list of ascending indices, ordered by their first index.
std::vector<std::vector<std::size_t>> drawn_groups(std::size_t scenes, std::size_t size,
                                                   std::uint64_t seed) {
  const std::vector<std::size_t> order = drawn_order(scenes, seed);
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t end = size; end <= scenes; end += size) {
    const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
    groups.emplace_back(at(end - size), at(end));
    std::sort(groups.back().begin(), groups.back().end());
  }
  std::sort(groups.begin(), groups.end());
  return groups;
}

bool is_same(const std::optional<RigidTransform>& a, const std::optional<RigidTransform>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return (a->rotation - b->rotation).cwiseAbs().maxCoeff() <= kSamePose &&
         (a->translation - b->translation).cwiseAbs().maxCoeff() <= kSamePose;
}

std::optional<RigidTransform> between(const std::optional<RigidTransform>& T_reference_target,
                                      const std::optional<RigidTransform>& T_reference_source) {
  if (!T_reference_target || !T_reference_source) return std::nullopt;
  return T_reference_target->inverse() * *T_reference_source;
}

/// The pairs calibrated in one scene: each sensor to the reference and, with `loops`, to the
/// sensors before it.
std::vector<CalibratedPair> pairs_of(const Scene& scene, bool loops) {
  const std::vector<SensorScan>& scans = scene.sensors;
  std::vector<CalibratedPair> pairs;
  for (const SensorScan& scan : scans) pairs.push_back(to_reference(scene, scan));
  if (!loops) return pairs;
  for (auto target = scans.begin(); target != scans.end(); ++target) {
    for (auto source = target + 1; source != scans.end(); ++source) {
      pairs.push_back(
          {sensor_pair(source->sensor, target->sensor), between(target->truth, source->truth),
           between(target->nominal, source->nominal), between(target->initial, source->initial)});
    }
  }
  return pairs;
}

/// Throws InputError if `scene` has more sensors and pairs of them than a store allows.
void check_number_of_pairs(const Scene& scene, const std::string& file) {
  const std::size_t sensors = scene.sensors.size();
  const std::size_t with_pairs = sensors + sensors * (sensors - 1) / 2;
  if (sensors == 0 || with_pairs <= kMaxVariants) return;
  throw InputError(file, "/loops",
                   "expected at most " + std::to_string(kMaxVariants) +
                       " sensors and pairs of them, found " + std::to_string(with_pairs) +
                       " in scene " + in_quotes(scene.name));
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
                            "\" in their names, which separates the sensors of a pair, found " +
                            in_quotes(scan.sensor)});
    }
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

/// Throws InputError if scenes have different references, because their poses are in different
/// frames.
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

/// Throws InputError unless `pair` of `scene` has the poses `known` from the first scene.
void require_one_rig(const Experiment& experiment, const SceneGroup& group,
                     const CalibratedPair& known, const Scene& scene, const CalibratedPair& pair) {
  for (const auto& [pose, what] : {std::pair(&CalibratedPair::truth, "true"),
                                   std::pair(&CalibratedPair::nominal, "nominal")}) {
    if (is_same(known.*pose, pair.*pose)) continue;
    throw InputError(
        experiment.file, "/scenes_per_trial",
        std::string("expected the same rig in all scenes of a trial, found different ") + what +
            " poses of sensor " + in_quotes(pair.name) + " in scenes " + in_quotes(scene.name) +
            " and " + in_quotes(group.scenes.front().name));
  }
}

/// Adds the pairs of `scene` that the group lacks.
void add_pairs(const Experiment& experiment, SceneGroup& group, const Scene& scene) {
  for (CalibratedPair& pair : pairs_of(scene, experiment.loops)) {
    const auto is_it = [&](const CalibratedPair& known) { return known.name == pair.name; };
    const auto known = std::find_if(group.pairs.begin(), group.pairs.end(), is_it);
    if (known == group.pairs.end()) {
      group.pairs.push_back(std::move(pair));
    } else {
      require_one_rig(experiment, group, *known, scene, pair);
    }
  }
}

SceneGroup group_of(const Experiment& experiment, std::vector<Scene> scenes) {
  const Scene& first = scenes.front();
  SceneGroup group{first.name, first.kind, {}, pairs_of(first, experiment.loops)};
  group.scenes = std::move(scenes);
  const std::size_t others = group.scenes.size() - 1;
  if (others > 0) group.name += "+" + std::to_string(others);
  for (std::size_t i = 1; i <= others; ++i) {
    add_pairs(experiment, group, group.scenes[i]);
    if (group.scenes[i].kind != group.kind) group.kind = "mixed";
  }
  return group;
}

}  // namespace

CalibratedPair to_reference(const Scene& scene, const SensorScan& scan) {
  return {
      {scan.sensor, scan.sensor, scene.reference.sensor}, scan.truth, scan.nominal, scan.initial};
}

std::vector<SceneGroup> scene_groups(const Experiment& experiment, std::vector<Scene> scenes) {
  require_one_reference(experiment, scenes);
  if (experiment.loops) {
    check_names_for_pairs(scenes, experiment.file);
    for (const Scene& scene : scenes) check_number_of_pairs(scene, experiment.file);
  }
  const auto size = static_cast<std::size_t>(experiment.scenes_per_trial);
  if (size > 1 && scenes.size() < size) {
    throw InputError(experiment.file, "/scenes_per_trial",
                     "expected at most the number of scenes, " + std::to_string(scenes.size()) +
                         ", found " + std::to_string(size));
  }
  std::vector<SceneGroup> groups;
  for (const std::vector<std::size_t>& indices :
       drawn_groups(scenes.size(), size, experiment.seed)) {
    std::vector<Scene> members;
    for (const std::size_t index : indices) members.push_back(std::move(scenes[index]));
    groups.push_back(group_of(experiment, std::move(members)));
  }
  return groups;
}

std::vector<SceneGroup> scene_groups(const Experiment& experiment,
                                     const std::filesystem::path& data_root) {
  return scene_groups(experiment, dataset_scenes(experiment, data_root));
}

}  // namespace croon::experiments
