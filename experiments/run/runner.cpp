#include "experiments/run/runner.hpp"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <set>

#include "experiments/run/channel_check.hpp"
#include "experiments/run/pipeline_tree.hpp"
#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/starts.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/geometry/length_bound.hpp"
#include "framework/pipeline/calibrate.hpp"

namespace croon::experiments {
namespace {

/// One sensor's cloud, or why it has none.
struct LoadedScan {
  std::shared_ptr<const Cloud> cloud;
  std::string failure;                    ///< The cloud is damaged or empty.
  std::optional<Fault> unavailable = {};  ///< It cannot be read now.
  double reading_s = 0.0;
};

TrialRecord failed(const TrialId& id, const std::string& reason) {
  TrialRecord record;
  record.id = id;
  record.status = Status::failed;
  record.reason = reason;
  return record;
}

bool is_finite(const RigidTransform& T) {
  return T.rotation.allFinite() && T.translation.allFinite();
}

/// Whether the error of the pose and its square are finite.
bool is_near(const RigidTransform& T) {
  return T.translation.cwiseAbs().maxCoeff() <= kLargestDistance_m;
}

bool is_within(const PoseError& error, const SuccessBounds& bounds) {
  return error.rotation_rad <= rad_from_deg(bounds.rotation_deg) &&
         error.translation_m <= bounds.translation_m;
}

/// The faults without the file's path: a reason must not depend on the data root.
std::string reasons(const InputError& error) {
  std::string text;
  for (const Fault& fault : error.faults()) {
    text += (text.empty() ? "" : "; ") + Fault{"", fault.where, fault.message}.line();
  }
  return text;
}

/// Reads the points of `scan`. Returns what is wrong with them, or an empty string. Throws
/// UnavailableFile.
std::string read_points(const SensorScan& scan, PointCloud& cloud) {
  try {
    cloud = scan.load();
  } catch (const UnavailableFile&) {
    throw;
  } catch (const InputError& error) {
    return reasons(error);
  }
  const auto is_finite_point = [](const Eigen::Vector3f& point) { return point.allFinite(); };
  return std::any_of(cloud.points.begin(), cloud.points.end(), is_finite_point)
             ? ""
             : "it has no points";
}

/// Completes the record of a trial whose pipeline did not fail.
void finish(TrialRecord& record, const Estimate& estimate, const SensorScan& scan,
            const SuccessBounds& bounds) {
  if (!is_finite(estimate.T_target_source)) {
    record.reason = "the pose is not finite";
    return;
  }
  if (!is_near(estimate.T_target_source)) {
    record.reason = "the pose is farther away than " + fixed_number(kLargestDistance_m, 0) + " m";
    return;
  }
  if (!is_rotation_matrix(estimate.T_target_source.rotation)) {
    record.reason = "the pose has no rotation: the columns of its matrix are not orthonormal";
    return;
  }
  record.T_reference_sensor = estimate.T_target_source;
  if (scan.truth) record.error = pose_error(estimate.T_target_source, *scan.truth);
  record.status = Status::finished;
  if (record.error) {
    record.status = is_within(*record.error, bounds) ? Status::success : Status::inaccurate;
  }
  if (estimate.rejection) {
    record.status = Status::rejected;
    record.reason = *estimate.rejection;
  }
}

/// Reads the cloud of `scan`. Its random streams are named by seed, scene and sensor.
LoadedScan load_scan(const SensorScan& scan, const std::string& scene, std::uint64_t seed,
                     const std::set<std::string>& channels) {
  const auto start = std::chrono::steady_clock::now();
  LoadedScan loaded;
  PointCloud points;
  std::string why_not;
  try {
    why_not = read_points(scan, points);
  } catch (const UnavailableFile& error) {
    loaded.unavailable = error.faults().front();
    return loaded;
  }
  if (why_not.empty()) {
    // Others would be copied with each filtered cloud, and nothing would read them.
    keep_channels(points, channels);
    loaded.cloud =
        std::make_shared<const Cloud>(std::move(points), cloud_stream(seed, scene, scan.sensor));
  } else {
    loaded.failure = "the cloud of " + scan.sensor + ": " + why_not;
  }
  loaded.reading_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return loaded;
}

/// Runs the start `planned` of `scene` through `tree`, and calls `at_end` with the record of each
/// variant.
void run_start(const Experiment& experiment, const PipelineTree& tree, const Scene& scene,
               const PlannedStart& planned, const LoadedScan& target, const LoadedScan& source,
               const std::function<void(const TrialRecord&)>& at_end) {
  const SensorScan& scan = scene.sensors[planned.sensor];
  const StreamKey key = trial_stream(
      {experiment.seed, scene.name, scene.reference.sensor, scan.sensor, planned.trial});
  const RigidTransform start = start_of(experiment, scene.name, scan, planned.trial);
  PipelineResult result = at_start(target.cloud, source.cloud, start);
  result.failure = target.failure.empty() ? source.failure : target.failure;
  result.estimate.trial =
      std::make_shared<const TrialName>(TrialName{scene.name, scan.sensor, planned.trial});
  run_tree(tree, std::move(result), key, [&](std::size_t variant, const PipelineResult& end) {
    TrialRecord record = failed(
        {experiment.variants[variant].name, scene.name, scan.sensor, planned.trial}, end.failure);
    record.steps = end.records;
    if (end.failure.empty()) finish(record, end.estimate, scan, experiment.success);
    at_end(record);
  });
}

/// The part of a plan that is one scene's.
struct ScenePlan {
  const PlannedStart* begin = nullptr;
  const PlannedStart* end = nullptr;
  std::size_t size() const { return static_cast<std::size_t>(end - begin); }
};

/// The clouds of a scene; those of sensors without trials are not read.
struct LoadedScene {
  LoadedScan reference;
  std::vector<LoadedScan> sensors;  ///< As Scene::sensors; empty for pairs of sensors.
};

/// The index of `sensor` in Scene::sensors.
std::size_t index_of(const Scene& scene, const std::string& sensor) {
  const auto is_it = [&](const SensorScan& scan) { return scan.sensor == sensor; };
  const auto found = std::find_if(scene.sensors.begin(), scene.sensors.end(), is_it);
  return static_cast<std::size_t>(found - scene.sensors.begin());
}

const LoadedScan& target_of(const Scene& scene, const LoadedScene& loaded, std::size_t sensor) {
  const SensorScan& scan = scene.sensors[sensor];
  return is_pair(scan) ? loaded.sensors[index_of(scene, scan.target)] : loaded.reference;
}

const LoadedScan& source_of(const Scene& scene, const LoadedScene& loaded, std::size_t sensor) {
  const SensorScan& scan = scene.sensors[sensor];
  return loaded.sensors[is_pair(scan) ? index_of(scene, scan.source) : sensor];
}

/// Whether the trials of `plan` need the cloud of each of Scene::sensors.
std::vector<bool> needed_clouds(const Scene& scene, const ScenePlan& plan) {
  std::vector<bool> is_needed(scene.sensors.size(), false);
  for (const PlannedStart* planned = plan.begin; planned != plan.end; ++planned) {
    is_needed[planned->sensor] = true;
  }
  for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
    const SensorScan& scan = scene.sensors[i];
    if (!is_pair(scan) || !is_needed[i]) continue;
    is_needed[i] = false;
    is_needed[index_of(scene, scan.source)] = is_needed[index_of(scene, scan.target)] = true;
  }
  return is_needed;
}

LoadedScene load_scene(const Scene& scene, const ScenePlan& plan, std::uint64_t seed,
                       const std::set<std::string>& channels) {
  const std::vector<bool> is_needed = needed_clouds(scene, plan);
  LoadedScene loaded;
  loaded.sensors.resize(scene.sensors.size());
  for_each_in_parallel(scene.sensors.size() + 1, [&](std::size_t i) {
    const bool is_reference = i == scene.sensors.size();
    if (!is_reference && !is_needed[i]) return;
    const SensorScan& scan = is_reference ? scene.reference : scene.sensors[i];
    LoadedScan& to = is_reference ? loaded.reference : loaded.sensors[i];
    // Isolated as trials are, so that the time of reading is its own.
    tbb::this_task_arena::isolate([&] { to = load_scan(scan, scene.name, seed, channels); });
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

/// Calls a run's listener, one call at a time. Makes no calls after an error has ended the run: the
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

/// What all scenes of a run have in common.
struct Run {
  const Experiment& experiment;
  const std::vector<Scene>& scenes;
  std::vector<PipelineTree> trees;  ///< By PlannedStart::variants.
  std::set<std::string> channels;   ///< That a step of a variant needs.
};

void run_scene(const Run& run, const ScenePlan& plan, SerialListener& notify) {
  const Scene& scene = run.scenes[plan.begin->scene];
  notify([&](const RunListener& listener) { listener.on_scene(scene.name); });
  const LoadedScene loaded = load_scene(scene, plan, run.experiment.seed, run.channels);
  const auto notify_unavailable = [&](const LoadedScan& scan) {
    if (!scan.unavailable) return;
    notify([&](const RunListener& listener) { listener.on_unavailable(*scan.unavailable); });
  };
  notify_unavailable(loaded.reference);
  for (const LoadedScan& scan : loaded.sensors) notify_unavailable(scan);
  const auto notify_trial = [&](const TrialRecord& record) {
    notify([&](const RunListener& listener) { listener.on_trial(record, timings_of(record)); });
  };
  for_each_in_parallel(plan.size(), [&](std::size_t i) {
    const PlannedStart& planned = plan.begin[i];
    const LoadedScan& target = target_of(scene, loaded, planned.sensor);
    const LoadedScan& source = source_of(scene, loaded, planned.sensor);
    if (target.unavailable || source.unavailable) return;
    // Isolated: a thread that waits inside a step must not start another trial, whose time would
    // count as this one's.
    tbb::this_task_arena::isolate([&] {
      run_start(run.experiment, run.trees[planned.variants], scene, planned, target, source,
                notify_trial);
    });
  });
  notify([&](const RunListener& listener) {
    listener.on_scene_timings(scene_timings(scene, loaded));
  });
}

/// The parts of the plan, one per scene.
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

/// Calls `use` for each scene, for at most `in_flight` of them at a time.
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
  SerialListener notify(listener);
  Run run{experiment, scenes, {}, needed_channels(experiment)};
  for (const std::vector<std::size_t>& variants : plan.variants) {
    run.trees.push_back(pipeline_tree(experiment, variants));
  }
  on_threads(jobs, [&] {
    // One more than threads: the next scene is loaded while the last trials of a scene run.
    for_each_scene(split_by_scene(plan.starts), static_cast<std::size_t>(jobs) + 1,
                   [&](const ScenePlan& scene) { run_scene(run, scene, notify); });
  });
}

}  // namespace croon::experiments
