#include "experiments/cli/checked_run.hpp"

#include <tbb/info.h>

#include "experiments/cli/data_root.hpp"
#include "experiments/engine/experiment_loader.hpp"
#include "experiments/engine/sensor_pairs.hpp"
#include "experiments/engine/starts.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {

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
  });
  if (!faults.empty()) throw InputError(std::move(faults));
  run.out = options.out;
  if (run.out.empty()) run.out = std::filesystem::path("results") / run.experiment.name;
  run.jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  return run;
}

}  // namespace croon::experiments
