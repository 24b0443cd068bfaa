#include "experiments/engine/trial_plan.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <tuple>

#include "framework/base/error.hpp"
#include "framework/base/nearest_name.hpp"

namespace croon::experiments {
namespace {

/// The whole number that is all of `text`; 0 where it is none.
int whole_number(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

using Ranks = std::map<std::string, std::size_t>;

Ranks variant_ranks(const Experiment& experiment) {
  Ranks ranks;
  for (const Variant& variant : experiment.variants) ranks.emplace(variant.name, ranks.size());
  return ranks;
}

/// Where a record stands in reports: variant, scene, sensor, trial.
using ReportKey = std::tuple<std::size_t, std::size_t, std::size_t, int>;

}  // namespace

Shard read_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const Shard shard{whole_number(text.substr(0, slash)), whole_number(text.substr(slash + 1))};
    if (shard.part >= 1 && shard.part <= shard.parts) return shard;
  }
  throw InputError("", "--shard", "expected K/N with 1 <= K <= N, found \"" + text + "\"");
}

std::vector<std::size_t> select_variants(const Experiment& experiment,
                                         const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const Variant& variant : experiment.variants) known.push_back(variant.name);
  std::vector<bool> is_selected(known.size(), names.empty());
  std::vector<Fault> faults;
  for (const std::string& name : names) {
    bool selects = false;
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (known[i] != name && known[i].compare(0, name.size() + 1, name + "/") != 0) continue;
      is_selected[i] = selects = true;
    }
    if (selects) continue;
    faults.push_back(
        {"", "--only", "there is no variant \"" + name + "\"" + name_hint(name, known)});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  std::vector<std::size_t> selected;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (is_selected[i]) selected.push_back(i);
  }
  return selected;
}

std::vector<PlannedTrial> plan_trials(const Experiment& experiment,
                                      const std::vector<Scene>& scenes,
                                      const Selection& selection) {
  std::vector<PlannedTrial> plan;
  const Shard shard = selection.shard;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    for (std::size_t sensor = 0; sensor < scenes[scene].sensors.size(); ++sensor) {
      // Wide: the step may be as large as an int.
      for (std::int64_t trial = shard.part - 1; trial < experiment.starts.trials;
           trial += shard.parts) {
        for (const std::size_t variant : selection.variants) {
          plan.push_back({scene, variant, sensor, static_cast<int>(trial)});
        }
      }
    }
  }
  return plan;
}

TrialId trial_id(const Experiment& experiment, const std::vector<Scene>& scenes,
                 const PlannedTrial& planned) {
  const Scene& scene = scenes[planned.scene];
  return {experiment.variants[planned.variant].name, scene.name,
          scene.sensors[planned.sensor].sensor, planned.trial};
}

std::vector<TrialRecord> in_report_order(const std::vector<TrialRecord>& records,
                                         const Experiment& experiment,
                                         const std::vector<Scene>& scenes) {
  const Ranks variants = variant_ranks(experiment);
  Ranks scene_ranks;
  std::map<std::string, Ranks> sensor_ranks;
  for (const Scene& scene : scenes) {
    scene_ranks.emplace(scene.name, scene_ranks.size());
    Ranks& sensors = sensor_ranks[scene.name];
    for (const SensorScan& scan : scene.sensors) sensors.emplace(scan.sensor, sensors.size());
  }
  std::vector<std::pair<ReportKey, TrialRecord>> keyed;
  for (const TrialRecord& record : records) {
    const TrialId& id = record.id;
    const auto variant = variants.find(id.variant);
    const auto scene = scene_ranks.find(id.scene);
    if (variant == variants.end() || scene == scene_ranks.end()) continue;
    if (id.trial >= experiment.starts.trials) continue;
    const Ranks& sensors = sensor_ranks[id.scene];
    const auto sensor = sensors.find(id.sensor);
    if (sensor == sensors.end()) continue;
    keyed.push_back({{variant->second, scene->second, sensor->second, id.trial}, record});
  }
  std::sort(keyed.begin(), keyed.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<TrialRecord> sorted;
  for (auto& [key, record] : keyed) sorted.push_back(std::move(record));
  return sorted;
}

}  // namespace croon::experiments
