#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/run/trial_plan.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// The data root: `asked`; if it is empty, the folder CROON_DATA, else data/.
std::filesystem::path data_root(const std::filesystem::path& asked);

/// Which trials of which experiment are asked for.
struct RunRequest {
  std::filesystem::path experiment;
  std::vector<std::filesystem::path> with = {};  ///< Workloads, see load_experiment.
  std::optional<std::string> text = {};  ///< JSON in the place of the file's; see parse_experiment.
  std::filesystem::path out;             ///< Empty: results/<name>.
  std::filesystem::path data;            ///< Empty: CROON_DATA, else data/.
  int jobs = 0;                          ///< 0: all cores.
  int trials = 0;                        ///< 0: as in the experiment.
  std::vector<std::string> only;
  std::string shard;  ///< "K/N"; empty: all.
};

/// A run that was checked as far as possible before anything is written.
struct CheckedRun {
  Experiment experiment;
  Selection selection;
  std::filesystem::path data_root;
  std::vector<SceneGroup> groups;
  std::filesystem::path out;
  int jobs = 1;
  std::set<std::string> damaged_files = {};  ///< Of clouds; known when all have been read once.
};

/// Reads and checks the request. Throws InputError with all faults.
CheckedRun check_run(const RunRequest& request, const Catalogue& catalogue);

}  // namespace croon::experiments
