#include "experiments/run/scene_groups.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/rng.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

/// Poses of one rig that differ by rounding are the same.
constexpr double kSamePose = 1e-9;

/// Indices below `count` in the order that `seed` draws.
std::vector<std::size_t> drawn_order(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Rng rng(StreamKey(seed).with("groups"));
  for (std::size_t left = count; left > 1; --left) {
    std::swap(order[left - 1], order[rng.below(left)]);
  }
  return order;
}

/// The groups, each a list of indices in ascending order, by their first.
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

/// Throws InputError unless the two scans of one sensor have the poses of one rig.
void require_one_rig(const Experiment& experiment, const Scene& group, const SensorScan& known,
                     const Scene& scene, const SensorScan& scan) {
  for (const auto& [pose, what] :
       {std::pair(&SensorScan::truth, "true"), std::pair(&SensorScan::nominal, "nominal")}) {
    if (is_same(known.*pose, scan.*pose)) continue;
    throw InputError(experiment.file, "/scenes_per_trial",
                     std::string("expected one rig in all scenes of a trial, found another ") +
                         what + " pose of sensor " + in_quotes(scan.sensor) + " in scene " +
                         in_quotes(scene.name) + " than in " + in_quotes(group.parts.front().name));
  }
}

/// Adds the sensors of `scene` that the group does not have.
void add_sensors(const Experiment& experiment, Scene& group, const Scene& scene) {
  for (const SensorScan& scan : scene.sensors) {
    const auto is_it = [&](const SensorScan& known) { return known.sensor == scan.sensor; };
    const auto known = std::find_if(group.sensors.begin(), group.sensors.end(), is_it);
    if (known == group.sensors.end()) {
      group.sensors.push_back(scan);
    } else {
      require_one_rig(experiment, group, *known, scene, scan);
    }
  }
}

Scene group_of(const Experiment& experiment, std::vector<Scene> parts) {
  Scene group = parts.front();
  group.name += "+" + std::to_string(parts.size() - 1);
  group.parts = std::move(parts);
  for (const Scene& scene : group.parts) {
    add_sensors(experiment, group, scene);
    if (scene.kind != group.kind) group.kind = "mixed";
  }
  return group;
}

}  // namespace

std::vector<Scene> grouped(const Experiment& experiment, std::vector<Scene> scenes) {
  const auto size = static_cast<std::size_t>(experiment.scenes_per_trial);
  if (size == 1) return scenes;
  if (scenes.size() < size) {
    throw InputError(experiment.file, "/scenes_per_trial",
                     "expected at most the number of scenes, " + std::to_string(scenes.size()) +
                         ", found " + std::to_string(size));
  }
  std::vector<Scene> groups;
  for (const std::vector<std::size_t>& indices :
       drawn_groups(scenes.size(), size, experiment.seed)) {
    std::vector<Scene> parts;
    for (const std::size_t index : indices) parts.push_back(std::move(scenes[index]));
    groups.push_back(group_of(experiment, std::move(parts)));
  }
  return groups;
}

std::vector<const Scene*> parts_of(const Scene& scene) {
  if (scene.parts.empty()) return {&scene};
  std::vector<const Scene*> parts;
  for (const Scene& part : scene.parts) parts.push_back(&part);
  return parts;
}

std::vector<const Scene*> parts_of(const std::vector<Scene>& scenes) {
  std::vector<const Scene*> parts;
  for (const Scene& scene : scenes) {
    for (const Scene* const part : parts_of(scene)) parts.push_back(part);
  }
  return parts;
}

}  // namespace croon::experiments
