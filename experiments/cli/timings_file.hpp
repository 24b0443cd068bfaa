#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "experiments/engine/trial_record.hpp"

namespace croon::experiments {

/// timings.csv, which grows as trials are done. A last line that a kill cut off is taken out when
/// the file is opened again.
class TimingsFile {
 public:
  /// Throws InputError where the file cannot be written.
  explicit TimingsFile(const std::filesystem::path& path);

  void add(const std::vector<TimingRow>& rows);

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

}  // namespace croon::experiments
