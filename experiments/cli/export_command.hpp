#pragma once

#include <filesystem>
#include <ostream>
#include <string>

namespace croon::experiments {

/// What `croon export` is asked for.
struct ExportOptions {
  std::filesystem::path folder;  ///< Of results.
  std::string format = "md";     ///< csv, md, latex or json.
  std::filesystem::path out;     ///< The file to write; empty: the output.
};

/// Writes a table for a paper of a folder of results, to `out` or to the file that is asked for.
/// Returns 0. Throws InputError where the format or the folder is not known.
int export_command(const ExportOptions& options, std::ostream& out);

}  // namespace croon::experiments
