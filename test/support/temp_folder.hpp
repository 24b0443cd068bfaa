#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace croon::test {

/// A folder of its own for a test; goes with all that is in it.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file, with the folders above it, and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& bytes) const;

 private:
  std::filesystem::path path_;
};

/// The message of the InputError that `work` throws; empty if it throws none.
std::string input_error(const std::function<void()>& work);

}  // namespace croon::test
