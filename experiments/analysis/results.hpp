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
#include "experiments/analysis/summary.hpp"
#include "experiments/analysis/verdicts.hpp"
#include "experiments/run/trial_record.hpp"
#include "experiments/store/store.hpp"
#include "experiments/store/store_header.hpp"

namespace croon::experiments {

/// A folder of results, read from its store alone: neither the experiment file nor the data need to
/// be there.
struct Results {
  std::string name;           ///< The experiment's.
  std::string description;    ///< The question it answers; may be empty.
  std::string commit;         ///< Of the program that made the trials; of the first of `builds`.
  std::vector<Build> builds;  ///< That contributed trials.
  std::uint64_t seed = 1;
  int trials = 0;            ///< Starts per variant, scene and sensor.
  std::size_t scenes = 0;    ///< Or groups of scenes,
  int scenes_per_trial = 1;  ///< if this is more than 1; what reports call a scene is then a group.
  std::size_t planned = 0;   ///< Trials of the variants that were run; fewer may be there.
  std::string manifest;      ///< JSON of manifest.json, without its host.
  std::vector<TrialRecord> records;  ///< In report order, without their steps.
  StepNumbers steps;                 ///< What steps report; empty unless it was asked for.
  std::vector<DiagnosticSummary> diagnostics;  ///< Of `steps`.
  Summary summary;
  std::map<std::string, std::string> references;  ///< The sensor that each is calibrated to.
  std::optional<Basin> basin;                     ///< Of a sweep.
  Verdicts verdicts;                              ///< Of the program, against the truth.
  Coverage coverage;                              ///< Of covariances, against the truth.
  std::vector<ClaimResult> claims;                ///< The claims of the experiment, checked.
  std::vector<Quoted> quoted;                     ///< Rows of other methods.
};

/// Whether a stage failed in one of the trials.
bool has_failed_trials(const Results& results);

/// Throws InputError if reports cannot be made of a store with this header; `file` is the store.
void check_reportable(const StoreHeader& header, const std::string& file);

/// Throws InputError if the folder has no store, or one of an unknown version.
Results read_results(const std::filesystem::path& folder, Content content = Content::trials);

}  // namespace croon::experiments
