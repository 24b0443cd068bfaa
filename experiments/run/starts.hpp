#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/run/pose_file.hpp"

namespace croon::experiments {

/// The pose of `pair` around which starts are drawn, if known.
const std::optional<RigidTransform>& centre_pose(StartCentre around, const CalibratedPair& pair);

/// A start `T_reference_sensor` of one trial: `centre` = (R, t) moved to (R_d R, t + d) by draws
/// within the ranges of `rule` (see StartRule). A rotation range of 180 deg is uniform on SO(3):
/// Shoemake, Uniform random rotations, Graphics Gems III, 1992. In a sweep, trial i is at level
/// `level_of(sweep, i)`: R_d rotates by the level's angle about an axis, or d has the level's
/// length along a direction, either uniform on the sphere. Depends only on its arguments.
Start draw_start(const StartRule& rule, const RigidTransform& centre, std::uint64_t seed,
                 const std::string& scene, const std::string& sensor, int trial);

/// The start of one trial of the group `scene`: drawn, from the file read by `resolve_starts`, or
/// the identity if the experiment has no starts.
Start start_of(const Experiment& experiment, const std::string& scene, const CalibratedPair& pair,
               int trial);

/// Prepares `experiment` for `start_of`: reads its file of starts or, if starts are drawn around a
/// pose, checks that every scene has it. Files are found by `found_input`. Throws InputError.
void resolve_starts(Experiment& experiment, const std::vector<SceneGroup>& groups,
                    const std::filesystem::path& data_root);

/// Reads the starts in the file `path`: for every sensor of `groups` trials 0 to n - 1, in any
/// order. Throws one InputError with the first faults of the file.
StartTable read_start_file(const std::filesystem::path& path,
                           const std::vector<SceneGroup>& groups);

}  // namespace croon::experiments
