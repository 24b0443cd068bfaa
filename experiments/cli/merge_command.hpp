#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

namespace croon::experiments {

/// What `croon merge` is asked for.
struct MergeOptions {
  std::vector<std::filesystem::path> folders;  ///< Results of shards.
  std::filesystem::path out;
  bool colours = false;  ///< Colours in the table.
};

/// Puts the trials of several folders of results of one experiment into one and writes all that a
/// run writes there: the same bytes as one run of them all. Returns the exit code: 0, or 3 where a
/// trial failed or is missing still. Throws InputError where the folders do not belong together;
/// then nothing is added to `out`.
int merge_command(const MergeOptions& options, std::ostream& out);

}  // namespace croon::experiments
