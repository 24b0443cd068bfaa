#include "experiments/cli/checked_run.hpp"

#include <tbb/info.h>

#include <algorithm>

#include "experiments/cli/data_root.hpp"
#include "experiments/engine/experiment_loader.hpp"
#include "experiments/engine/sensor_pairs.hpp"
#include "experiments/engine/starts.hpp"
#include "framework/base/error.hpp"
#include "framework/base/nearest_name.hpp"

namespace croon::experiments {
namespace {

/// Throws InputError where a claim is of a sensor that there is not: it would never be measured.
void check_claimed_sensors(const Experiment& experiment, const std::vector<std::string>& sensors) {
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < experiment.claims.expect.size(); ++i) {
    const std::string& sensor = experiment.claims.expect[i].sensor;
    if (sensor.empty() || std::find(sensors.begin(), sensors.end(), sensor) != sensors.end()) {
      continue;
    }
    faults.push_back({experiment.file, "/expect/" + std::to_string(i) + "/sensor",
                      "expected a sensor of the dataset, found \"" + sensor + "\"" +
                          name_hint(sensor, sensors)});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace

CheckedRun check_run(const RunOptions& options, const Catalogue& catalogue) {
  CheckedRun run;
  run.experiment = load_experiment(options.experiment, catalogue);
  run.data_root = data_root(options.data);
  std::vector<Fault> faults;
  collect_faults(faults, [&] { set_trials(run.experiment.starts, options.trials); });
  collect_faults(faults,
                 [&] { run.selection.variants = select_variants(run.experiment, options.only); });
  collect_faults(faults, [&] {
    if (!options.shard.empty()) run.selection.shard = read_shard(options.shard);
  });
  collect_faults(faults, [&] {
    run.scenes = scenes_of(run.experiment, run.data_root);
    resolve_starts(run.experiment, run.scenes, run.data_root);
    check_claimed_sensors(run.experiment, sensor_names(run.scenes));
  });
  if (!faults.empty()) throw InputError(std::move(faults));
  run.out = options.out;
  if (run.out.empty()) run.out = std::filesystem::path("results") / run.experiment.name;
  run.jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  return run;
}

}  // namespace croon::experiments
