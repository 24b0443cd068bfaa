#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace croon::experiments {

/// A file that a command writes for its user, not part of a folder of results.
struct OutputFile {
  std::filesystem::path path;
  std::string bytes;
};

/// Creates `folder`. Throws InputError if that fails or the folder is not writable.
void make_folder(const std::filesystem::path& folder);

/// Writes the files, each completely or not at all. Throws InputError, before writing any, if one
/// exists with different bytes, and if one cannot be written.
void write_output_files(const std::vector<OutputFile>& files);

/// The same, but replaces existing files, as a user expects who recreates a table. Throws
/// InputError, before writing any, if a file is one of `inputs`, in a folder of results, a cloud,
/// an experiment, a CSV file of a kind that experiments use (unless the new file is of the same
/// kind), a file that a dataset reads in addition to clouds, a link, or not a regular file.
void replace_output_files(const std::vector<OutputFile>& files,
                          const std::vector<std::filesystem::path>& inputs = {});

/// Throws InputError in the cases in which `replace_output_files` refuses to write. For a CSV file,
/// `bytes` may be its first line only.
void refuse_to_replace(const std::vector<OutputFile>& files,
                       const std::vector<std::filesystem::path>& inputs = {});

}  // namespace croon::experiments
