#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// Checks the experiment files `paths`; a folder stands for every *.json below it. Prints `FILE:
/// ok` or all of its faults, the latter to `err`. Returns 0, or 2 where a file is at fault. The
/// data need not be there. Throws InputError where a path does not exist or a folder holds no
/// experiment.
int validate_command(const std::vector<std::filesystem::path>& paths, const Catalogue& catalogue,
                     std::ostream& out, std::ostream& err);

}  // namespace croon::experiments
