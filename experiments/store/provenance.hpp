#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/store/store_header.hpp"

namespace croon::experiments {

/// A file that results depend on.
struct InputFile {
  std::string path;  ///< Relative to the data root where it lies below it.
  std::string sha256;
  /// Its finite points, and how many were dropped as not finite; nothing where it cannot be loaded.
  std::optional<std::size_t> points, dropped_non_finite;
};

/// The files that the clouds of `scenes` are in, in order, each once; read on `jobs` threads.
/// Throws InputError where one cannot be read.
std::vector<InputFile> input_files(const std::vector<Scene>& scenes,
                                   const std::filesystem::path& data_root, int jobs);

/// All that decides the result of a trial but its pipeline: dataset, inputs (files and the rig's
/// poses), starts (but not how many), seed, success bounds, and the program itself.
Provenance provenance_of(const Experiment& experiment, const std::vector<Scene>& scenes,
                         const std::vector<InputFile>& inputs);

/// What the store of a run says of itself. `manifest` is that of manifest_json.
StoreHeader header_of(const Experiment& experiment, const std::vector<Scene>& scenes,
                      const Provenance& provenance, const std::string& manifest);

}  // namespace croon::experiments
