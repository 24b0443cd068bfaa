#include "experiments/run/run_request.hpp"

#include <tbb/info.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

#include "experiments/file/experiment.hpp"
#include "experiments/run/channel_check.hpp"
#include "experiments/run/given_poses.hpp"
#include "experiments/run/given_velocities.hpp"
#include "experiments/run/starts.hpp"
#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

/// Throws InputError if a claim names an unknown sensor: the claim would never be measured.
void check_claimed_sensors(const Experiment& experiment, const std::vector<std::string>& sensors) {
  std::vector<Fault> faults;
  for (const Claim& claim : experiment.claims) {
    const std::string& sensor = claim.sensor;
    if (sensor.empty() || std::find(sensors.begin(), sensors.end(), sensor) != sensors.end()) {
      continue;
    }
    faults.push_back({claim.sensor_file, claim.sensor_pointer,
                      "expected a sensor of the dataset, found \"" + sensor + "\"" +
                          name_hint(sensor, sensors)});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

/// Throws InputError if a parameter of a step is for a sensor that no scene has: it would have no
/// effect.
void check_sensors_of_steps(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                            const Selection& selection) {
  std::vector<std::string> sensors;
  std::set<std::string> known;
  const auto add = [&](const std::string& sensor) {
    if (known.insert(sensor).second) sensors.push_back(sensor);
  };
  for (const SceneGroup& group : groups) {
    for (const Scene& scene : group.scenes) {
      add(scene.reference.sensor);
      for (const SensorScan& scan : scene.sensors) add(scan.sensor);
    }
  }
  std::vector<Fault> faults;
  std::set<std::pair<std::string, std::string>> reported;  // Most variants share their steps.
  for (const std::size_t index : selection.variants) {
    const Variant& variant = experiment.variants[index];
    for (const NamedStep& step : variant.pipeline) {
      for (const std::string& sensor : step.step.flow().named_sensors) {
        if (known.count(sensor) > 0 || !reported.emplace(step.name, sensor).second) continue;
        faults.push_back({experiment.file, location_of(experiment, variant, step),
                          "expected a sensor of the dataset, found " + in_quotes(sensor) +
                              name_hint(sensor, sensors)});
      }
    }
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace

std::filesystem::path data_root(const std::filesystem::path& requested) {
  if (!requested.empty()) return requested;
  const char* const set = std::getenv("CROON_DATA");
  return set != nullptr && *set != '\0' ? set : "data";
}

CheckedRun check_run(const RunRequest& request, const Catalogue& catalogue) {
  CheckedRun run;
  run.experiment =
      request.text ? parse_experiment(*request.text, request.experiment, catalogue, request.with)
                   : load_experiment(request.experiment, catalogue, request.with);
  run.data_root = data_root(request.data);
  std::vector<Fault> faults;
  collect_faults(faults, [&] { set_trials(run.experiment.starts, request.trials); });
  collect_faults(faults,
                 [&] { run.selection.variants = select_variants(run.experiment, request.only); });
  collect_faults(faults, [&] {
    if (!request.shard.empty()) run.selection.shard = read_shard(request.shard);
  });
  collect_faults(faults, [&] {
    run.groups = scene_groups(run.experiment, run.data_root);
    // Each check reports its faults independently of the others.
    collect_faults(faults, [&] {
      resolve_starts(run.experiment, run.groups, run.data_root);
      check_plan_size(run.experiment, run.groups, run.selection);
    });
    collect_faults(faults, [&] { check_channels(run.experiment, run.groups, run.selection); });
    collect_faults(faults,
                   [&] { check_sensors_of_steps(run.experiment, run.groups, run.selection); });
    collect_faults(faults, [&] { resolve_poses(run.experiment, run.groups, run.data_root); });
    collect_faults(faults, [&] { resolve_velocities(run.experiment, run.groups, run.data_root); });
    collect_faults(faults,
                   [&] { check_claimed_sensors(run.experiment, sensor_names(run.groups)); });
  });
  if (!faults.empty()) throw InputError(std::move(faults));
  run.out = request.out;
  if (run.out.empty()) run.out = std::filesystem::path("results") / run.experiment.name;
  run.jobs = request.jobs > 0 ? request.jobs : tbb::info::default_concurrency();
  return run;
}

}  // namespace croon::experiments
