#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/run/scene_groups.hpp"
#include "framework/stage/given_motions.hpp"

namespace croon::experiments {

/// The header of a file of velocities: `scene` and the columns of velocity_numbers(). Each further
/// line is the velocity of the car in one scene. `croon simulate` writes this format.
const std::string& velocity_header();

/// The header of a file that also has standard deviations.
const std::string& velocity_header_with_stds();

/// The velocities of a file.
struct VelocityTable {
  GivenMotions motions;
  std::string sha256;
};

/// Reads the file of velocities `path`, with at most one line for each of the scenes `names`, and
/// at least one for each of `needed`. Throws one InputError with the first faults.
VelocityTable read_velocity_file(const std::filesystem::path& path,
                                 const std::vector<std::string>& names,
                                 const std::vector<std::string>& needed);

/// Reads the files of velocities named by steps of `experiment`, and passes their content to the
/// steps. The digest of the file becomes a parameter of the step; the files are added to
/// Experiment::files. Throws InputError with the faults of all files.
void resolve_velocities(Experiment& experiment, const std::vector<SceneGroup>& groups,
                        const std::filesystem::path& data_root);

}  // namespace croon::experiments
