#include "experiments/cli/checked_run.hpp"

#include <tbb/info.h>

#include "experiments/cli/data_root.hpp"
#include "experiments/engine/experiment_loader.hpp"
#include "experiments/engine/starts.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

/// Takes `trials` for those of the file; 0 keeps them.
void set_trials(Experiment& experiment, int trials) {
  if (trials > kMaxTrials) {
    throw InputError("", "--trials",
                     "expected a whole number from 1 to " + std::to_string(kMaxTrials) +
                         ", found " + std::to_string(trials));
  }
  if (trials > 0) experiment.starts.trials = trials;
}

}  // namespace

CheckedRun check_run(const RunOptions& options, const Catalogue& catalogue) {
  CheckedRun run;
  run.experiment = load_experiment(options.experiment, catalogue);
  run.data_root = data_root(options.data);
  std::vector<Fault> faults;
  collect_faults(faults, [&] { set_trials(run.experiment, options.trials); });
  collect_faults(faults,
                 [&] { run.selection.variants = select_variants(run.experiment, options.only); });
  collect_faults(faults, [&] {
    if (!options.shard.empty()) run.selection.shard = read_shard(options.shard);
  });
  collect_faults(faults, [&] {
    run.scenes = run.experiment.dataset->scenes(run.data_root);
    check_centres(run.experiment, run.scenes);
  });
  if (!faults.empty()) throw InputError(std::move(faults));
  run.out = options.out;
  if (run.out.empty()) run.out = std::filesystem::path("results") / run.experiment.name;
  run.jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  run.is_whole = options.only.empty() && options.shard.empty() && options.trials == 0;
  return run;
}

}  // namespace croon::experiments
