#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/run/scene_groups.hpp"

namespace croon::experiments {

/// A file that results depend on.
struct InputFile {
  std::string path;  ///< Relative to the data root if it is below it.
  std::string sha256;
  /// The numbers of finite points and of dropped non-finite points; std::nullopt if the file could
  /// not be loaded.
  std::optional<std::size_t> points, dropped_non_finite;
  std::string file;  ///< The path from the dataset; not in manifests.
};

/// Reads the files of the clouds of `groups`, each once, on `jobs` threads, and returns them in
/// order. From then on scans must match these bytes: SensorScan::load throws UnavailableFile for
/// different ones. Clouds up to a total of 64 MB are kept, so that their first load does not read
/// the file again. Throws UnavailableFile if a file cannot be read.
std::vector<InputFile> record_inputs(std::vector<SceneGroup>& groups,
                                     const std::filesystem::path& data_root, int jobs);

}  // namespace croon::experiments
