#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/basin.hpp"
#include "experiments/analysis/claims.hpp"
#include "experiments/analysis/coverage.hpp"
#include "experiments/analysis/diagnostics.hpp"
#include "experiments/analysis/step_times.hpp"
#include "experiments/analysis/summary.hpp"
#include "experiments/analysis/verdicts.hpp"
#include "experiments/run/trial_record.hpp"
#include "experiments/store/store.hpp"
#include "experiments/store/store_header.hpp"

namespace croon::experiments {

/// What a store contains.
struct StoredResults {
  std::string name;           ///< The experiment's.
  std::string description;    ///< The question that the experiment answers; may be empty.
  std::string commit;         ///< Commit of the first of `builds`.
  std::vector<Build> builds;  ///< Builds that contributed trials.
  std::uint64_t seed = 1;
  int trials = 0;                    ///< Starts per variant, scene and sensor.
  std::size_t scenes = 0;            ///< Number of scenes, or of groups of scenes
  int scenes_per_trial = 1;          ///< if this is above 1; reports then call a group a scene.
  std::size_t planned = 0;           ///< Planned trials of the variants that were run.
  std::string manifest;              ///< JSON of manifest.json, without its host.
  std::vector<TrialRecord> records;  ///< In report order, without their steps.
  StepNumbers steps;                 ///< Numbers reported by steps; empty unless requested.
  std::map<std::string, std::string> references;  ///< The sensor that each is calibrated to.
  std::vector<Quoted> quoted;                     ///< Rows of other methods.
};

/// The results in a folder, read only from its store, and everything that is computed from them;
/// the experiment file and the data are not needed.
struct Results : StoredResults {
  std::vector<DiagnosticSummary> diagnostics;  ///< Summaries of `steps`.
  std::vector<StepTime> times;                 ///< Empty unless set by the caller.
  Summary summary;
  std::optional<Basin> basin;       ///< Only of a sweep.
  AcceptanceCurve acceptance;       ///< Verdicts of the program against ground truth.
  Coverage coverage;                ///< Covariances against ground truth.
  std::vector<ClaimResult> claims;  ///< The claims of the experiment, checked.
};

/// Whether a stage failed in one of the trials.
bool has_failed_trials(const Results& results);

/// Throws InputError if reports cannot be made of a store with this header; `file` is the store.
void check_reportable(const StoreHeader& header, const std::string& file);

/// Reads the results. Throws InputError if the folder has no store, or one of an unknown version.
Results read_results(const std::filesystem::path& folder, Content content = Content::trials);

}  // namespace croon::experiments
