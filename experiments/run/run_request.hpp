#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/run/trial_plan.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// The data root: `requested`; if it is empty, the folder CROON_DATA, else data/.
std::filesystem::path data_root(const std::filesystem::path& requested);

/// The requested trials of an experiment.
struct RunRequest {
  std::filesystem::path experiment;
  std::vector<std::filesystem::path> with = {};  ///< Workloads, see load_experiment.
  std::optional<std::string> text = {};  ///< JSON to use instead of the file; see parse_experiment.
  std::filesystem::path out;             ///< Empty: results/<name>.
  std::filesystem::path data;            ///< Empty: CROON_DATA, else data/.
  int jobs = 0;                          ///< 0: all cores.
  int trials = 0;                        ///< 0: as in the experiment.
  std::vector<std::string> only;
  std::string shard;  ///< "K/N"; empty: all.
};

/// A run whose request has been checked as far as possible without writing.
struct CheckedRun {
  Experiment experiment;
  Selection selection;
  std::filesystem::path data_root;
  std::vector<SceneGroup> groups;
  std::filesystem::path out;
  int jobs = 1;
  std::set<std::string> damaged_files = {};  ///< Clouds; known once all have been read.
};

/// Reads and checks the request. Throws InputError with all faults.
CheckedRun check_run(const RunRequest& request, const Catalogue& catalogue);

}  // namespace croon::experiments
