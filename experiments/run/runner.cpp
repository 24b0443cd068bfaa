#include "experiments/run/runner.hpp"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <mutex>

#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/threads.hpp"
#include "experiments/run/trial.hpp"

namespace croon::experiments {
namespace {

/// The part of a plan that is one scene's.
struct ScenePlan {
  const PlannedStart* begin = nullptr;
  const PlannedStart* end = nullptr;
  std::size_t size() const { return static_cast<std::size_t>(end - begin); }
};

/// The clouds of a scene; sensors that no trial asks for are not read.
struct LoadedScene {
  LoadedScan reference;
  std::vector<LoadedScan> sensors;  ///< As Scene::sensors; of pairs nothing, their sensors have it.
};

/// The place in Scene::sensors of the sensor that is called so.
std::size_t place_of(const Scene& scene, const std::string& sensor) {
  const auto is_it = [&](const SensorScan& scan) { return scan.sensor == sensor; };
  const auto found = std::find_if(scene.sensors.begin(), scene.sensors.end(), is_it);
  return static_cast<std::size_t>(found - scene.sensors.begin());
}

const LoadedScan& target_of(const Scene& scene, const LoadedScene& loaded, std::size_t sensor) {
  const SensorScan& scan = scene.sensors[sensor];
  return is_pair(scan) ? loaded.sensors[place_of(scene, scan.target)] : loaded.reference;
}

const LoadedScan& source_of(const Scene& scene, const LoadedScene& loaded, std::size_t sensor) {
  const SensorScan& scan = scene.sensors[sensor];
  return loaded.sensors[is_pair(scan) ? place_of(scene, scan.source) : sensor];
}

/// Which sensors' clouds the trials of `plan` want, as Scene::sensors.
std::vector<bool> wanted_clouds(const Scene& scene, const ScenePlan& plan) {
  std::vector<bool> is_wanted(scene.sensors.size(), false);
  for (const PlannedStart* planned = plan.begin; planned != plan.end; ++planned) {
    is_wanted[planned->sensor] = true;
  }
  for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
    const SensorScan& scan = scene.sensors[i];
    if (!is_pair(scan) || !is_wanted[i]) continue;
    is_wanted[i] = false;
    is_wanted[place_of(scene, scan.source)] = is_wanted[place_of(scene, scan.target)] = true;
  }
  return is_wanted;
}

LoadedScene load_scene(const Scene& scene, const ScenePlan& plan, std::uint64_t seed) {
  const std::vector<bool> is_wanted = wanted_clouds(scene, plan);
  LoadedScene loaded;
  loaded.sensors.resize(scene.sensors.size());
  for_each_in_parallel(scene.sensors.size() + 1, [&](std::size_t i) {
    const bool is_reference = i == scene.sensors.size();
    if (!is_reference && !is_wanted[i]) return;
    const SensorScan& scan = is_reference ? scene.reference : scene.sensors[i];
    LoadedScan& to = is_reference ? loaded.reference : loaded.sensors[i];
    // Isolated like trials: the time of reading is its own.
    tbb::this_task_arena::isolate([&] { to = load_scan(scan, scene.name, seed); });
  });
  return loaded;
}

std::vector<TimingRow> timings_of(const TrialRecord& record) {
  std::vector<TimingRow> rows;
  for (const StepRecord& step : record.steps) rows.push_back({record.id, step.name, step.seconds});
  return rows;
}

void add_scan_timings(std::vector<TimingRow>& rows, const std::string& scene,
                      const std::string& sensor, const LoadedScan& scan) {
  if (!scan.cloud) return;
  const TrialId once{"", scene, sensor, -1};
  rows.push_back({once, "reading", scan.reading_s});
  for (const OnceTiming& timing : scan.cloud->timings()) {
    rows.push_back({once, timing.what, timing.seconds});
  }
}

std::vector<TimingRow> scene_timings(const Scene& scene, const LoadedScene& loaded) {
  std::vector<TimingRow> rows;
  add_scan_timings(rows, scene.name, scene.reference.sensor, loaded.reference);
  for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
    add_scan_timings(rows, scene.name, scene.sensors[i].sensor, loaded.sensors[i]);
  }
  return rows;
}

/// A run's listener, told one thing at a time, and nothing any more once an error ends the run:
/// what still comes in then may have been cut short.
class Telling {
 public:
  explicit Telling(const RunListener& listener) : listener_(listener) {}

  template <class Tell>
  void operator()(const Tell& tell) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!tbb::is_current_task_group_canceling()) tell(listener_);
  }

 private:
  const RunListener& listener_;
  std::mutex mutex_;
};

/// What all scenes of a run share.
struct Run {
  const Experiment& experiment;
  const std::vector<Scene>& scenes;
  std::vector<PipelineTree> trees;  ///< By PlannedStart::variants.
};

void run_scene(const Run& run, const ScenePlan& plan, Telling& tell) {
  const Scene& scene = run.scenes[plan.begin->scene];
  tell([&](const RunListener& listener) { listener.on_scene(scene.name); });
  const LoadedScene loaded = load_scene(scene, plan, run.experiment.seed);
  const auto tell_trial = [&](const TrialRecord& record) {
    tell([&](const RunListener& listener) { listener.on_trial(record, timings_of(record)); });
  };
  for_each_in_parallel(plan.size(), [&](std::size_t i) {
    const PlannedStart& planned = plan.begin[i];
    // Isolated: a thread that waits inside a step must not pick up another trial, whose time would
    // count as this one's.
    tbb::this_task_arena::isolate([&] {
      run_start(run.experiment, run.trees[planned.variants], scene, planned,
                target_of(scene, loaded, planned.sensor), source_of(scene, loaded, planned.sensor),
                tell_trial);
    });
  });
  tell([&](const RunListener& listener) {
    listener.on_scene_timings(scene_timings(scene, loaded));
  });
}

/// The plan scene by scene.
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

/// Calls `use` for each scene, at most `in_flight` of them at a time.
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

}  // namespace

void run_trials(const Experiment& experiment, const std::vector<Scene>& scenes, const Plan& plan,
                int jobs, const RunListener& listener) {
  Telling tell(listener);
  Run run{experiment, scenes, {}};
  for (const std::vector<std::size_t>& variants : plan.variants) {
    run.trees.push_back(pipeline_tree(experiment, variants));
  }
  on_threads(jobs, [&] {
    // One more than threads: while the last trials of a scene run, the next is loaded.
    for_each_scene(split_by_scene(plan.starts), static_cast<std::size_t>(jobs) + 1,
                   [&](const ScenePlan& scene) { run_scene(run, scene, tell); });
  });
}

}  // namespace croon::experiments
