#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

namespace croon::experiments {

/// Writes a page of Markdown to `out`: for each folder of results what was run, every number that
/// its experiment expects beside ours, in or out of its band, and the quoted rows of other methods.
/// Returns 0, or 3 where a number is out or was not measured. Throws InputError where a folder has
/// no results.
int claims_command(const std::vector<std::filesystem::path>& folders, std::ostream& out);

}  // namespace croon::experiments
