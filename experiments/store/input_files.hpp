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
  /// The numbers of finite points and of points that were dropped as not finite; std::nullopt if
  /// the file could not be loaded.
  std::optional<std::size_t> points, dropped_non_finite;
  std::string file;  ///< The path as the dataset gives it; in no manifest.
};

/// The files of the clouds of `groups`, in order, each once; read on `jobs` threads. After that the
/// scans are held to these bytes: SensorScan::load throws UnavailableFile if it reads others.
/// Clouds of up to 64 MB in all are kept, so that the first load of these reads no file again.
/// Throws UnavailableFile if a file cannot be read.
std::vector<InputFile> record_inputs(std::vector<SceneGroup>& groups,
                                     const std::filesystem::path& data_root, int jobs);

}  // namespace croon::experiments
