#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/report/basin.hpp"
#include "experiments/report/claim_result.hpp"
#include "experiments/report/summary.hpp"
#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// What a folder of results says, read from its store alone: neither the experiment file nor the
/// data need be there.
struct Results {
  std::string name;         ///< The experiment's.
  std::string description;  ///< The question it answers; may be empty.
  std::string commit;       ///< Of the program that made the trials.
  std::uint64_t seed = 1;
  int trials = 0;  ///< Starts per variant, scene and sensor.
  std::size_t scenes = 0;
  std::size_t planned = 0;           ///< Trials of the variants that were run; fewer may be there.
  std::string manifest;              ///< JSON of manifest.json, without its host.
  std::vector<TrialRecord> records;  ///< In report order, without their steps.
  Summary summary;
  std::optional<Basin> basin;       ///< Of a sweep.
  std::vector<ClaimResult> claims;  ///< What the experiment expects, and what was found.
  std::vector<Quoted> quoted;       ///< Rows of other methods.
};

/// Throws InputError where the folder has no store, or one that this program does not know.
Results read_results(const std::filesystem::path& folder);

}  // namespace croon::experiments
