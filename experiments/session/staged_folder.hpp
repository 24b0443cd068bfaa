#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace croon::experiments {

/// A folder of results whose files appear all at once: they are written to a folder beside it, and
/// moved when all are complete.
class StagedFolder {
 public:
  /// Throws InputError if `folder` cannot be used: it is a file, or it contains files but not
  /// `marker`, which earlier results have.
  StagedFolder(std::filesystem::path folder, const std::string& marker);
  /// Deletes unpublished files.
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Creates the folder that files are written to. Throws InputError if that fails.
  const std::filesystem::path& make_staging();

  /// Moves all files to the folder, replacing files of the same names. Returns the sorted names of
  /// the other files in the folder, left by earlier results. Throws InputError if one cannot be
  /// moved.
  std::vector<std::string> publish();

 private:
  std::filesystem::path folder_;
  std::filesystem::path staging_;
};

}  // namespace croon::experiments
