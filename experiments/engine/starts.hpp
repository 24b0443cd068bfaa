#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/engine/experiment.hpp"

namespace croon::experiments {

/// The pose of `scan` that starts are drawn around, where it is known.
const std::optional<RigidTransform>& centre_pose(StartCentre around, const SensorScan& scan);

/// A start `T_reference_sensor` of one trial: `centre` = (R, t) moved to (R_d R, t + d) by draws
/// within `rule`'s ranges (DESIGN.md, section 4). A rotation range of 180 deg is uniform on SO(3):
/// Shoemake, Uniform random rotations, Graphics Gems III, 1992. Depends on the arguments and on
/// nothing else.
RigidTransform draw_start(const StartRule& rule, const RigidTransform& centre, std::uint64_t seed,
                          const std::string& scene, const std::string& sensor, int trial);

/// Throws InputError, with a line per sensor, where a scene lacks the pose that starts are drawn
/// around.
void check_centres(const Experiment& experiment, const std::vector<Scene>& scenes);

}  // namespace croon::experiments
