#include "experiments/engine/runner.hpp"

#include <algorithm>
#include <mutex>

#include "experiments/engine/threads.hpp"
#include "experiments/engine/trial.hpp"

namespace croon::experiments {
namespace {

/// The part of a plan that is one scene's.
struct ScenePlan {
  const PlannedTrial* begin;
  const PlannedTrial* end;
  std::size_t size() const { return static_cast<std::size_t>(end - begin); }
};

/// The clouds of a scene; sensors that no trial asks for are not read.
struct LoadedScene {
  LoadedScan target;
  std::vector<LoadedScan> sources;
};

LoadedScene load_scene(const Scene& scene, const ScenePlan& plan, std::uint64_t seed) {
  std::vector<bool> is_wanted(scene.sensors.size(), false);
  for (const PlannedTrial* planned = plan.begin; planned != plan.end; ++planned) {
    is_wanted[planned->sensor] = true;
  }
  LoadedScene loaded;
  loaded.sources.resize(scene.sensors.size());
  for_each_in_parallel(scene.sensors.size() + 1, [&](std::size_t i) {
    if (i == scene.sensors.size()) {
      loaded.target = load_scan(scene.reference, scene.name, seed);
    } else if (is_wanted[i]) {
      loaded.sources[i] = load_scan(scene.sensors[i], scene.name, seed);
    }
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
  add_scan_timings(rows, scene.name, scene.reference.sensor, loaded.target);
  for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
    add_scan_timings(rows, scene.name, scene.sensors[i].sensor, loaded.sources[i]);
  }
  return rows;
}

void run_scene(const Experiment& experiment, const std::vector<Scene>& scenes,
               const ScenePlan& plan, const RunListener& listener) {
  const Scene& scene = scenes[plan.begin->scene];
  listener.on_scene(scene.name);
  const LoadedScene loaded = load_scene(scene, plan, experiment.seed);
  std::mutex listening;
  for_each_in_parallel(plan.size(), [&](std::size_t i) {
    const PlannedTrial& planned = plan.begin[i];
    TrialRecord record;
    // Isolated: a thread that waits inside a step must not pick up another trial, whose time would
    // count as this one's.
    tbb::this_task_arena::isolate([&] {
      record = run_trial(experiment, experiment.variants[planned.variant].pipeline,
                         trial_id(experiment, scenes, planned), scene.sensors[planned.sensor],
                         loaded.target, loaded.sources[planned.sensor]);
    });
    const std::lock_guard<std::mutex> lock(listening);
    listener.on_trial(record, timings_of(record));
  });
  listener.on_scene_timings(scene_timings(scene, loaded));
}

}  // namespace

void run_trials(const Experiment& experiment, const std::vector<Scene>& scenes,
                const std::vector<PlannedTrial>& plan, int jobs, const RunListener& listener) {
  on_threads(jobs, [&] {
    const PlannedTrial* const end = plan.data() + plan.size();
    for (const PlannedTrial* begin = plan.data(); begin != end;) {
      const auto is_other = [&](const PlannedTrial& planned) {
        return planned.scene != begin->scene;
      };
      const PlannedTrial* const next = std::find_if(begin, end, is_other);
      run_scene(experiment, scenes, {begin, next}, listener);
      begin = next;
    }
  });
}

}  // namespace croon::experiments
