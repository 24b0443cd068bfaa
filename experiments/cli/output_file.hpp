#pragma once

#include <filesystem>
#include <string>

namespace croon::experiments {

/// Writes `bytes` to the file `path`, whole or not at all. Throws InputError where it cannot be
/// written, and where it would take the place of `input`, which they were made from, or of a store.
void write_output_file(const std::filesystem::path& path, const std::string& bytes,
                       const std::filesystem::path& input);

}  // namespace croon::experiments
