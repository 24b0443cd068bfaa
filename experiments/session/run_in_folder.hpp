#pragma once

#include <cstddef>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "experiments/analysis/results.hpp"
#include "experiments/run/run_request.hpp"
#include "experiments/session/result_files.hpp"
#include "framework/base/progress.hpp"

namespace croon::experiments {

/// How a run uses existing results in its folder, and what it displays.
struct FolderRun {
  bool no_share = false;    ///< Runs the variants one by one.
  bool fresh = false;       ///< Deletes the results in the folder and starts over.
  bool same_build = false;  ///< Refuses to continue with trials of another build.
  ProgressStyle progress = ProgressStyle::none;
  /// Called at the start of a scene and after each trial, from any thread, one call at a time. If
  /// it throws, the run ends; finished trials stay in the store.
  std::function<void()> check = [] {};
};

/// The work of a run.
struct Work {
  StoreHeader stored;    ///< Header of the existing store; without provenance if there is none.
  StoreHeader header;    ///< Header of the store after the run.
  Plan plan;             ///< The missing trials.
  std::size_t done = 0;  ///< Requested trials already in the store.
};

/// The header of the store of `run`. From then on the clouds of the run must match their digests.
/// Called before the folder is changed: throws UnavailableFile if a cloud cannot be read.
StoreHeader header_of(CheckedRun& run);

/// The work of `run` in its folder, which is not changed. Throws InputError if the trials in the
/// folder were made from different inputs.
Work work_of(const CheckedRun& run, StoreHeader header, const FolderRun& how);

/// The results of a run, and a line for each cloud that was unavailable or, in a group, damaged.
struct FolderResults {
  Results results;
  std::vector<std::string> complaints;
};

/// Runs the missing trials, and writes the store and all reports into `folder`, the folder of
/// `run`; progress goes to `progress_out`. Throws InputError as work_of does.
FolderResults run_in_folder(const CheckedRun& run, StoreHeader header, const OutputFolder& folder,
                            const FolderRun& how, std::ostream& progress_out);

}  // namespace croon::experiments
