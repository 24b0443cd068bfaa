#include "experiments/run/runner.hpp"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>

#include "experiments/run/channel_check.hpp"
#include "experiments/run/loaded_scene.hpp"
#include "experiments/run/pipeline_tree.hpp"
#include "experiments/run/scene_groups.hpp"
#include "experiments/run/starts.hpp"
#include "experiments/run/trial_end.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/pipeline/calibrate.hpp"

namespace croon::experiments {
namespace {

/// The part of a plan for one scene or one group of scenes.
struct ScenePlan {
  const PlannedStart* begin = nullptr;
  const PlannedStart* end = nullptr;
};

/// Planned starts of one trial that run together: those of all its sensors if a step sees the whole
/// rig, otherwise a single one.
using Unit = std::vector<const PlannedStart*>;

/// A group of scenes with its clouds.
struct LoadedGroup {
  const SceneGroup* group = nullptr;
  std::vector<LoadedScene> scenes;
};

/// Data shared by all scenes of a run.
struct Run {
  const Experiment& experiment;
  const std::vector<SceneGroup>& groups;
  const Plan& plan;
  std::vector<PipelineTree> trees;  ///< Indexed by PlannedStart::variants.
  std::set<std::string> channels;   ///< Channels that a step of a variant needs.
  bool sees_rig = false;            ///< Whether a step sees the whole rig.
};

/// Calls a run's listener, one call at a time. Stops after an error has ended the run, because
/// results that still arrive may be incomplete.
class SerialListener {
 public:
  explicit SerialListener(const RunListener& listener) : listener_(listener) {}

  template <class Call>
  void operator()(const Call& call) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!tbb::is_current_task_group_canceling()) call(listener_);
  }

 private:
  const RunListener& listener_;
  std::mutex mutex_;
};

std::vector<Unit> units_of(const ScenePlan& plan, bool sees_rig) {
  std::vector<Unit> units;
  std::map<int, std::size_t> unit_of_trial;
  for (const PlannedStart* planned = plan.begin; planned != plan.end; ++planned) {
    const auto [known, is_new] = unit_of_trial.emplace(planned->trial, units.size());
    if (is_new || !sees_rig) {
      units.push_back({planned});
    } else {
      units[known->second].push_back(planned);
    }
  }
  return units;
}

/// The names of the sensors whose clouds the trials of `plan` need. With a step that sees the whole
/// rig this includes sensors whose results are known, because the others may depend on them.
std::set<std::string> needed_sensors(const SceneGroup& group, const ScenePlan& plan,
                                     bool sees_rig) {
  std::set<std::string> names;
  const auto add = [&](const SensorPair& pair) { names.insert({pair.source, pair.target}); };
  for (const PlannedStart* planned = plan.begin; planned != plan.end; ++planned) {
    add(group.pairs[planned->sensor]);
  }
  if (sees_rig) std::for_each(group.pairs.begin(), group.pairs.end(), add);
  return names;
}

LoadedGroup load_group(const Run& run, const ScenePlan& plan) {
  LoadedGroup loaded;
  loaded.group = &run.groups[plan.begin->scene];
  const std::set<std::string> sensors = needed_sensors(*loaded.group, plan, run.sees_rig);
  const std::vector<Scene>& scenes = loaded.group->scenes;
  loaded.scenes.resize(scenes.size());
  for_each_in_parallel(scenes.size(), [&](std::size_t i) {
    loaded.scenes[i] = load_scene(scenes[i], sensors, run.experiment.seed, run.channels);
  });
  return loaded;
}

/// The sensors of one trial in all scenes of its group, with one start per sensor.
struct Trial {
  Rig rig;
  std::vector<std::size_t> pairs;  ///< For each member of the rig its index in SceneGroup::pairs.
  bool is_available = true;        ///< Whether all clouds are readable.
};

/// Adds the pair with index `index` in one scene of the group, if the scene has it.
void add_member(Trial& trial, const Run& run, const SceneGroup& group, std::size_t index,
                const LoadedScene& loaded, int number) {
  const CalibratedPair& pair = group.pairs[index];
  const std::optional<CloudPair> clouds = cloud_pair(loaded, pair);
  if (!clouds) return;
  if (clouds->target->unavailable || clouds->source->unavailable) {
    trial.is_available = false;
    return;
  }
  const Scene& scene = *loaded.scene;
  const StreamKey key =
      trial_stream({run.experiment.seed, scene.name, scene.reference.sensor, pair.name, number});
  PipelineResult result = at_start(clouds->target->cloud, clouds->source->cloud,
                                   start_of(run.experiment, group.name, pair, number));
  const std::string& of_target = clouds->target->failure;
  result.failure = of_target.empty() ? clouds->source->failure : of_target;
  result.estimate.extras.put(kTrialId, {"", group.name, pair.name, number});
  trial.rig.push_back({scene.name, pair.target, pair.source, key, std::move(result)});
  trial.pairs.push_back(index);
}

Trial trial_at_start(const Run& run, const LoadedGroup& loaded, const Unit& unit) {
  const SceneGroup& group = *loaded.group;
  Trial trial;
  for (const LoadedScene& scene : loaded.scenes) {
    for (std::size_t pair = 0; pair < group.pairs.size(); ++pair) {
      if (!run.sees_rig && pair != unit.front()->sensor) continue;
      add_member(trial, run, group, pair, scene, unit.front()->trial);
    }
  }
  return trial;
}

/// The number of scenes in which a sensor failed, and the reason in the first of them; empty if
/// none.
std::string lost_scenes(const std::vector<const RigMember*>& members) {
  const auto failed = [](const RigMember* member) { return !member->result.failure.empty(); };
  const auto first = std::find_if(members.begin(), members.end(), failed);
  if (first == members.end()) return "";
  return std::to_string(std::count_if(first, members.end(), failed)) + " of " +
         counted(members.size(), "scene") + " failed, in " + (*first)->scene + ": " +
         (*first)->result.failure;
}

/// The result of the members of `rig` that are the pair with index `pair` of `pairs`. For several
/// scenes, the reason names the scene.
PipelineResult result_of(const SceneGroup& group, const Rig& rig,
                         const std::vector<std::size_t>& pairs, std::size_t pair) {
  std::vector<const RigMember*> members;
  for (std::size_t i = 0; i < rig.size(); ++i) {
    if (pairs[i] == pair) members.push_back(&rig[i]);
  }
  PipelineResult result = result_of_sensor(members);
  if (group.scenes.size() == 1) return result;
  if (result.failure.empty()) {
    result.note = lost_scenes(members);
  } else {
    result.failure = "in all scenes; in " + members.front()->scene + ": " + result.failure;
  }
  return result;
}

/// The variants planned for a start of `unit`, in order.
std::vector<std::size_t> variants_of(const Plan& plan, const Unit& unit) {
  std::set<std::size_t> variants;
  for (const PlannedStart* const planned : unit) {
    const std::vector<std::size_t>& list = plan.variants[planned->variants];
    variants.insert(list.begin(), list.end());
  }
  return {variants.begin(), variants.end()};
}

/// Runs the planned starts of one trial, and calls `at_end` with each record.
void run_unit(const Run& run, const LoadedGroup& loaded, const Unit& unit,
              const std::function<void(const TrialRecord&)>& at_end) {
  Trial trial = trial_at_start(run, loaded, unit);
  if (!trial.is_available) return;
  const SceneGroup& group = *loaded.group;
  const int number = unit.front()->trial;
  const auto record_variant = [&](std::size_t variant, const Rig& rig) {
    for (const PlannedStart* const planned : unit) {
      const std::vector<std::size_t>& list = run.plan.variants[planned->variants];
      if (std::find(list.begin(), list.end(), variant) == list.end()) continue;
      const CalibratedPair& pair = group.pairs[planned->sensor];
      at_end(record_of({run.experiment.variants[variant].name, group.name, pair.name, number},
                       result_of(group, rig, trial.pairs, planned->sensor), pair.truth,
                       run.experiment.success));
    }
  };
  const StreamKey key = StreamKey(run.experiment.seed)
                            .with("rig")
                            .with(group.name)
                            .with(static_cast<std::uint64_t>(number));
  if (unit.size() == 1) {
    run_tree(run.trees[unit.front()->variants], std::move(trial.rig), key, record_variant);
  } else {
    // After a kill, different variants may be missing for the sensors of a trial.
    run_tree(pipeline_tree(run.experiment, variants_of(run.plan, unit)), std::move(trial.rig), key,
             record_variant);
  }
}

std::vector<TimingRow> timings_of(const TrialRecord& record) {
  std::vector<TimingRow> rows;
  for (const StepRecord& step : record.steps) rows.push_back({record.id, step.name, step.seconds});
  return rows;
}

void run_scene(const Run& run, const ScenePlan& plan, SerialListener& notify) {
  const std::string& name = run.groups[plan.begin->scene].name;
  notify([&](const RunListener& listener) { listener.on_scene(name); });
  const LoadedGroup loaded = load_group(run, plan);
  for (const LoadedScene& scene : loaded.scenes) {
    for (const Fault& fault : unavailable_clouds(scene)) {
      notify([&](const RunListener& listener) { listener.on_unavailable(fault); });
    }
  }
  if (loaded.scenes.size() > 1) {
    for (const LoadedScene& scene : loaded.scenes) {
      for (const std::string& reason : damaged_clouds(scene)) {
        notify([&](const RunListener& listener) { listener.on_damaged(reason); });
      }
    }
  }
  const auto notify_trial = [&](const TrialRecord& record) {
    notify([&](const RunListener& listener) { listener.on_trial(record, timings_of(record)); });
  };
  const std::vector<Unit> units = units_of(plan, run.sees_rig);
  for_each_in_parallel(units.size(), [&](std::size_t i) {
    // Isolated: a thread that waits inside a step must not start another trial, whose time would
    // be added to this one's.
    tbb::this_task_arena::isolate([&] { run_unit(run, loaded, units[i], notify_trial); });
  });
  for (const LoadedScene& scene : loaded.scenes) {
    notify([&](const RunListener& listener) { listener.on_scene_timings(scene_timings(scene)); });
  }
}

/// Splits the plan into one part per scene.
std::vector<ScenePlan> split_by_scene(const std::vector<PlannedStart>& starts) {
  std::vector<ScenePlan> scenes;
  const PlannedStart* const end = starts.data() + starts.size();
  for (const PlannedStart* begin = starts.data(); begin != end; begin = scenes.back().end) {
    const auto is_other = [&](const PlannedStart& planned) {
      return planned.scene != begin->scene;
    };
    scenes.push_back({begin, std::find_if(begin, end, is_other)});
  }
  return scenes;
}

/// Calls `use` for each scene, for at most `in_flight` scenes at a time.
template <class Use>
void for_each_scene(const std::vector<ScenePlan>& plans, std::size_t in_flight, const Use& use) {
  auto next = plans.begin();
  const auto take = [&](tbb::flow_control& control) {
    if (next != plans.end()) return *next++;
    control.stop();
    return ScenePlan{};
  };
  tbb::parallel_pipeline(
      in_flight, tbb::make_filter<void, ScenePlan>(tbb::filter_mode::serial_in_order, take) &
                     tbb::make_filter<ScenePlan, void>(tbb::filter_mode::parallel, use));
}

/// Whether any step of a planned variant sees the whole rig.
bool sees_rig(const Experiment& experiment, const Plan& plan) {
  return std::any_of(plan.variants.begin(), plan.variants.end(), [&](const auto& variants) {
    return std::any_of(variants.begin(), variants.end(), [&](std::size_t variant) {
      return has_rig_step(experiment.variants[variant].pipeline);
    });
  });
}

}  // namespace

void run_trials(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                const Plan& plan, int jobs, const RunListener& listener) {
  SerialListener notify(listener);
  Run run{experiment, groups, plan, {}, needed_channels(experiment), sees_rig(experiment, plan)};
  for (const std::vector<std::size_t>& variants : plan.variants) {
    run.trees.push_back(pipeline_tree(experiment, variants));
  }
  // One more than threads: the next scene is loaded while the last trials of a scene run.
  const int in_flight = jobs / experiment.scenes_per_trial + 1;
  on_threads(jobs, [&] {
    for_each_scene(split_by_scene(plan.starts), static_cast<std::size_t>(in_flight),
                   [&](const ScenePlan& scene) { run_scene(run, scene, notify); });
  });
}

}  // namespace croon::experiments
