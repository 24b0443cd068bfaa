#pragma once

#include <filesystem>
#include <vector>

#include "experiments/cli/run_command.hpp"
#include "experiments/engine/trial_plan.hpp"

namespace croon::experiments {

/// A run of which everything was checked that can be before anything is written.
struct CheckedRun {
  Experiment experiment;
  Selection selection;
  std::filesystem::path data_root;
  std::vector<Scene> scenes;
  std::filesystem::path out;
  int jobs = 1;
};

/// Reads and checks what `options` ask for. Throws InputError with all the faults.
CheckedRun check_run(const RunOptions& options, const Catalogue& catalogue);

}  // namespace croon::experiments
