#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"

namespace croon::experiments {

/// The pose of `scan` that starts are drawn around, where it is known.
const std::optional<RigidTransform>& centre_pose(StartCentre around, const SensorScan& scan);

/// A start `T_reference_sensor` of one trial: `centre` = (R, t) moved to (R_d R, t + d) by draws
/// within `rule`'s ranges (DESIGN.md, section 4). A rotation range of 180 deg is uniform on SO(3):
/// Shoemake, Uniform random rotations, Graphics Gems III, 1992. In a sweep trial i is at level
/// `level_of(sweep, i)`: R_d turns by the level's angle about an axis, or d has the level's length
/// along a direction, that is uniform on the sphere. Depends on the arguments and on nothing else.
Start draw_start(const StartRule& rule, const RigidTransform& centre, std::uint64_t seed,
                 const std::string& scene, const std::string& sensor, int trial);

/// The start of one trial, drawn or out of the file that `resolve_starts` read.
Start start_of(const Experiment& experiment, const std::string& scene, const SensorScan& scan,
               int trial);

/// Makes `experiment` ready to be asked for the starts of `scenes`: reads its file of starts, else
/// looks that no scene lacks the pose that starts are drawn around. A relative file is below
/// `data_root`, else beside the experiment. Throws InputError.
void resolve_starts(Experiment& experiment, const std::vector<Scene>& scenes,
                    const std::filesystem::path& data_root);

}  // namespace croon::experiments
