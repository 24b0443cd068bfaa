#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// Writes, for each variant and scene, the clouds of the rig in the reference's frame, each sensor
/// at the estimate of its first trial that finished: `folder/<variant>/<scene>.ply`, coloured by
/// sensor, and `<scene>.vdb`, the leaves of 0.05 m that they occupy. `records` are in report order.
/// Returns the files that could not be written and why, a line each.
std::vector<std::string> write_fused_clouds(const Experiment& experiment,
                                            const std::vector<Scene>& scenes,
                                            const std::vector<TrialRecord>& records,
                                            const std::filesystem::path& folder);

}  // namespace croon::experiments
