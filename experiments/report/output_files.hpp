#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace croon::experiments {

/// A file that a command writes for its user, beside no results.
struct OutputFile {
  std::filesystem::path path;
  std::string bytes;
};

/// Writes the files, each whole or not at all. Throws InputError, before one is written, if one of
/// them is there with other bytes. Throws InputError if one cannot be written.
void write_output_files(const std::vector<OutputFile>& files);

/// The same, but a file that is there is replaced, as a user expects who makes a table again.
/// Throws InputError, before one is written, if it is one of `inputs`, a file of a folder of
/// results, a cloud, an experiment, a CSV file of a kind that experiments name (but for one of that
/// kind), a file that a dataset reads beside clouds, a link or no file.
void replace_output_files(const std::vector<OutputFile>& files,
                          const std::vector<std::filesystem::path>& inputs = {});

/// Throws InputError if `replace_output_files` does before it writes. Of the bytes of a CSV file
/// its first line suffices.
void refuse_to_replace(const std::vector<OutputFile>& files,
                       const std::vector<std::filesystem::path>& inputs = {});

}  // namespace croon::experiments
