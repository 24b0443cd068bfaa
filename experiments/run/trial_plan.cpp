#include "experiments/run/trial_plan.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <unordered_set>

#include "framework/base/error.hpp"
#include "framework/base/memory.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

/// The whole number in `text`; 0 if it is not a whole number.
int whole_number(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

/// Trials from `begin` up to, but excluding, `end`.
struct TrialRange {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

/// The trials of the scene with index `scene` that belong to the shard.
TrialRange trials_of(const Shard& shard, std::size_t scene, std::size_t scenes, int trials) {
  const std::int64_t all = static_cast<std::int64_t>(scenes) * trials;
  const auto begin_of = [&](std::int64_t part) {
    return part * (all / shard.parts) + std::min(part, all % shard.parts);
  };
  const std::int64_t first = static_cast<std::int64_t>(scene) * trials;
  return {std::clamp<std::int64_t>(begin_of(shard.part - 1) - first, 0, trials),
          std::clamp<std::int64_t>(begin_of(shard.part) - first, 0, trials)};
}

/// A cursor over the finished trials of one variant, scene and sensor.
class DoneTrials {
 public:
  DoneTrials(const std::vector<TrialIndex>& done, const TrialIndex& first)
      : next_(std::lower_bound(done.begin(), done.end(), first)), end_(done.end()) {}

  /// Whether `trial` is finished. Calls must be in ascending order.
  bool has(const TrialIndex& trial) {
    while (next_ != end_ && *next_ < trial) ++next_;
    return next_ != end_ && *next_ == trial;
  }

 private:
  std::vector<TrialIndex>::const_iterator next_, end_;
};

/// The index of `variants` in the plan's lists; added if missing.
std::size_t list_of(Plan& plan, const std::vector<std::size_t>& variants) {
  // Searched from the end: neighbouring trials usually miss the same variants.
  const auto found = std::find(plan.variants.rbegin(), plan.variants.rend(), variants);
  if (found != plan.variants.rend()) {
    return static_cast<std::size_t>(plan.variants.rend() - found) - 1;
  }
  plan.variants.push_back(variants);
  return plan.variants.size() - 1;
}

/// Adds the trials of one sensor of one scene; `sensor` is its index in sensor_names().
void add_starts(Plan& plan, const PlannedStart& first, std::size_t sensor, const TrialRange& trials,
                const std::vector<std::size_t>& variants, const std::vector<TrialIndex>& done) {
  std::vector<DoneTrials> done_of;
  const int begin = static_cast<int>(trials.begin);
  for (const std::size_t variant : variants) {
    done_of.emplace_back(done, TrialIndex{variant, first.scene, sensor, begin});
  }
  PlannedStart start = first;
  for (start.trial = begin; start.trial < trials.end; ++start.trial) {
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < variants.size(); ++i) {
      if (!done_of[i].has({variants[i], first.scene, sensor, start.trial})) {
        missing.push_back(variants[i]);
      }
    }
    if (missing.empty()) continue;
    start.variants = list_of(plan, missing);
    plan.starts.push_back(start);
    plan.trials += missing.size();
  }
}

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

std::vector<std::string> sensor_names(const std::vector<SceneGroup>& groups) {
  std::vector<std::string> names;
  std::unordered_set<std::string> known;
  for (const SceneGroup& group : groups) {
    for (const SensorPair& pair : group.pairs) {
      if (known.insert(pair.name).second) names.push_back(pair.name);
    }
  }
  return names;
}

void check_plan_size(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                     const Selection& selection) {
  // All results are in memory when they are summarised: about a kilobyte per record with its steps.
  constexpr double kRecordBytes = 1000.0;
  double starts = 0.0;
  for (std::size_t scene = 0; scene < groups.size(); ++scene) {
    const TrialRange trials =
        trials_of(selection.shard, scene, groups.size(), total_trials(experiment.starts));
    starts += static_cast<double>(trials.end - trials.begin) *
              static_cast<double>(groups[scene].pairs.size());
  }
  const double trials = starts * static_cast<double>(selection.variants.size());
  require_memory(starts * sizeof(PlannedStart) + trials * kRecordBytes,
                 "a plan of " + fixed_number(trials, 0) + " trials",
                 "use fewer --trials or --only some variants, or run it in parts with --shard",
                 {experiment.file, "", ""});
}

Plan plan_trials(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                 const Selection& selection, const std::vector<TrialIndex>& done) {
  Plan plan;
  const std::vector<std::string> names = sensor_names(groups);
  for (std::size_t scene = 0; scene < groups.size(); ++scene) {
    const TrialRange trials =
        trials_of(selection.shard, scene, groups.size(), total_trials(experiment.starts));
    for (std::size_t sensor = 0; sensor < groups[scene].pairs.size(); ++sensor) {
      const std::string& name = groups[scene].pairs[sensor].name;
      const auto index = std::find(names.begin(), names.end(), name) - names.begin();
      add_starts(plan, {scene, sensor, 0, 0}, static_cast<std::size_t>(index), trials,
                 selection.variants, done);
    }
  }
  return plan;
}

}  // namespace croon::experiments
