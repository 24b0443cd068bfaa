#pragma once

#include <filesystem>
#include <vector>

#include "experiments/run/scene_groups.hpp"

namespace croon::experiments {

/// Reads the files of poses named by variants of `experiment`. Each such variant gets a first step
/// "poses", which sets the pose of the trial from the file; the trial fails if the file has none.
/// The step's parameter is the digest of the file. The files are added to Experiment::files. Throws
/// InputError with the faults of all files.
void resolve_poses(Experiment& experiment, const std::vector<SceneGroup>& groups,
                   const std::filesystem::path& data_root);

}  // namespace croon::experiments
