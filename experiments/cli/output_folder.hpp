#pragma once

#include <filesystem>

namespace croon::experiments {

/// The folder that a run writes into, made where it is missing and kept from other processes until
/// this object goes.
class OutputFolder {
 public:
  /// Throws InputError where the folder cannot be made or written to, or another croon is working
  /// in it.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::filesystem::path store() const { return path_ / "store.sqlite"; }
  std::filesystem::path timings() const { return path_ / "timings.csv"; }
  std::filesystem::path clouds() const { return path_ / "clouds"; }
  std::filesystem::path file(const char* name) const { return path_ / name; }

  /// Deletes what an earlier run left here, and nothing else.
  void clear() const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace croon::experiments
