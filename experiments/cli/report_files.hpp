#pragma once

#include <filesystem>
#include <string>

#include "experiments/cli/results_folder.hpp"

namespace croon::experiments {

/// Writes all that is told of `results` into `folder`, the tables and the pictures, and takes away
/// what an earlier run left and this one has not. `manifest` are the bytes of manifest.json.
void write_reports(const std::filesystem::path& folder, const Results& results,
                   const std::string& manifest);

/// What is printed of them, the same that the files hold: the tables.
std::string result_text(const Results& results, bool colours);

/// Whether a trial could not go on.
bool has_failed_trials(const Results& results);

}  // namespace croon::experiments
