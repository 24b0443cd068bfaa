#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/analysis/results.hpp"

namespace croon::experiments {

/// The files of a folder of results that more than one command knows.
inline constexpr const char* kTimings = "timings.csv";
inline constexpr const char* kPicture = "before_after.png";

/// The names of all files that a run writes into a folder of results, beside its store: what a run
/// must be able to write, and what `--fresh` deletes.
std::vector<std::string> result_file_names();

/// Writes the tables and the pictures of `results` into `folder`, and removes those that an earlier
/// run left and this one lacks. `manifest` are the bytes of manifest.json.
void write_reports(const std::filesystem::path& folder, const Results& results,
                   const std::string& manifest);

}  // namespace croon::experiments
