#pragma once

#include <cstddef>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "experiments/analysis/results.hpp"
#include "experiments/report/result_files.hpp"
#include "experiments/run/run_request.hpp"
#include "framework/base/progress.hpp"

namespace croon::experiments {

/// How a run treats what its folder has, and what it shows.
struct FolderRun {
  bool no_share = false;    ///< Runs the variants one by one.
  bool fresh = false;       ///< Deletes the results in the folder and starts over.
  bool same_build = false;  ///< Refuses to go on with trials of another build.
  ProgressStyle progress = ProgressStyle::none;
  /// Called when a scene begins and after each trial, from any thread, one call at a time. If it
  /// throws, the run ends, and what is done stays in the store.
  std::function<void()> check = [] {};
};

/// What a run has before it.
struct Work {
  StoreHeader stored;    ///< Of the store as it is; without provenance if there is none.
  StoreHeader header;    ///< Of the store as it will be.
  Plan plan;             ///< What is missing.
  std::size_t done = 0;  ///< Trials that were asked for and are there.
};

/// What the store of `run` will say of itself. The clouds of the run are then held to their
/// digests. Comes before the folder is changed: it throws UnavailableFile if a cloud cannot be
/// read.
StoreHeader header_of(CheckedRun& run);

/// The work of `run` in its folder, which is not changed. Throws InputError if the folder has
/// trials that were made from something else.
Work work_of(const CheckedRun& run, StoreHeader header, const FolderRun& how);

/// The results of a run, and a line for each cloud that was not available or, in a group, damaged.
struct FolderResults {
  Results results;
  std::vector<std::string> complaints;
};

/// Runs what is missing, and writes the store and all reports into `folder`, which is that of
/// `run`; progress goes to `progress_out`. Throws InputError as work_of does.
FolderResults run_in_folder(const CheckedRun& run, StoreHeader header, const OutputFolder& folder,
                            const FolderRun& how, std::ostream& progress_out);

}  // namespace croon::experiments
