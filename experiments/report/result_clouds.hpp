#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/analysis/summary.hpp"
#include "experiments/file/experiment.hpp"
#include "experiments/run/scene_groups.hpp"

namespace croon::experiments {

// The clouds of a rig at its results, as a picture and as files: at the poses that the trials of
// all scenes agree on, as extrinsics.json has them.

/// Draws one scene from above as PNG: on the left each sensor's cloud at the start of its first
/// trial, on the right at the agreed pose of the first variant. The scene is the first in which all
/// sensors have a result. Returns its name, or "" if there is none; then no picture is
/// written. Throws InputError if the file cannot be written, and UnavailableFile if a cloud is not
/// that of the run any more.
std::string draw_before_after(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                              const Summary& summary, const std::filesystem::path& path);

/// What write_fused_clouds came to.
struct FusedClouds {
  std::vector<std::string> complaints;  ///< What could not be written and why, a line each.
  bool is_any = false;                  ///< False if no trials agree, so that there is none.
};

/// Writes, for each variant and scene, the clouds of the rig in the reference's frame, each sensor
/// at its agreed pose if it has a result in the scene: `folder/<variant>/<scene>.ply`, coloured by
/// sensor, and `<scene>.vdb`, the leaves of 0.05 m that they occupy.
FusedClouds write_fused_clouds(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                               const Summary& summary, const std::filesystem::path& folder);

}  // namespace croon::experiments
