#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/stage/dataset.hpp"

namespace croon::experiments {

/// Draws one scene from above as PNG: on the left each sensor's cloud where the first trial
/// started, on the right where that trial of the first variant ended. The scene is the first one of
/// which all sensors came to an end. Returns its name, or nothing where there is none; then there
/// is no picture either. Throws InputError where the file cannot be written or a cloud cannot be
/// read.
std::string draw_before_after(const Experiment& experiment, const std::vector<Scene>& scenes,
                              const std::vector<TrialRecord>& records,
                              const std::filesystem::path& path);

}  // namespace croon::experiments
