#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// timings.csv, which grows as trials are done. When the file is opened again, a last line that a
/// kill cut off is removed.
class TimingsFile {
 public:
  /// Throws InputError if the file cannot be written.
  explicit TimingsFile(const std::filesystem::path& path);

  void add(const std::vector<TimingRow>& rows);
  /// After this, the rows that were added outlive a kill of the process.
  void flush();

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

/// Writes to `path` the rows of timings.csv of all `folders` that have one, each row once.
void merge_timings(const std::vector<std::filesystem::path>& folders,
                   const std::filesystem::path& path);

}  // namespace croon::experiments
