#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/analysis/summary.hpp"
#include "experiments/file/experiment.hpp"
#include "experiments/run/scene_groups.hpp"

namespace croon::experiments {

// The clouds of a calibrated rig, as a picture and as files: at the poses that the trials of all
// scenes agree on, as in extrinsics.json.

/// Draws one scene from above as PNG: on the left each sensor's cloud at the initial guess of its
/// first trial, on the right at the agreed pose of the first variant. The scene is the first in
/// which all sensors have a result. Returns its name, or "" if there is none; then no picture is
/// written. Throws InputError if the file cannot be written, and UnavailableFile if a cloud has
/// changed since the run.
std::string draw_before_after(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                              const Summary& summary, const std::filesystem::path& path);

/// The outcome of write_fused_clouds.
struct FusedClouds {
  std::vector<std::string>
      complaints;       ///< A line per file that could not be written, with the reason.
  bool is_any = false;  ///< False if no trials agree, so that there are no clouds.
};

/// Writes the merged clouds of the rig for each variant and scene, in the reference frame, each
/// sensor at its agreed pose if it has a result in the scene: `folder/<variant>/<scene>.ply`,
/// coloured by sensor, and `<scene>.vdb`, the occupied leaves of 0.05 m.
FusedClouds write_fused_clouds(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                               const Summary& summary, const std::filesystem::path& folder);

}  // namespace croon::experiments
