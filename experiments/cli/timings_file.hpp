#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// timings.csv, which grows as trials are done. A last line that a kill cut off is taken out when
/// the file is opened again.
class TimingsFile {
 public:
  /// Throws InputError where the file cannot be written.
  explicit TimingsFile(const std::filesystem::path& path);

  void add(const std::vector<TimingRow>& rows);
  /// What was added outlives a kill from then on.
  void flush();

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

/// Writes to `path` the rows of timings.csv of all `folders` that have one, each row once.
void merge_timings(const std::vector<std::filesystem::path>& folders,
                   const std::filesystem::path& path);

}  // namespace croon::experiments
