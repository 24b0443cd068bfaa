#pragma once

#include <filesystem>

#include "experiments/file/experiment.hpp"
#include "framework/stage/dataset.hpp"

namespace croon::experiments {

/// Writes the folder of `scene` below `dataset`: a PCD per sensor, `initial_extrinsic.txt` with the
/// starts of trial 0, and last `lidar_cloud_path.txt`, whose presence tells that all is there. The
/// scans must be such that can be measured. Throws InputError where a file cannot be written.
void write_scene(const Experiment& experiment, const Scene& scene,
                 const std::filesystem::path& dataset);

/// Whether `write_scene` came to its end.
bool is_written(const Scene& scene, const std::filesystem::path& dataset);

/// Draws `scene` as `<scene>.png` beside its folder: the place where the dataset can draw it, and
/// its clouds from above, by the truth.
void draw_scene(const Scene& scene, const std::filesystem::path& dataset);

}  // namespace croon::experiments
