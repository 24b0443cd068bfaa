#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/stage/dataset.hpp"

namespace croon::experiments {

/// Draws one scene from above as PNG: on the left each sensor's cloud at the start of its first
/// trial, on the right at the result of that trial of the first variant. The scene is the first in
/// which all sensors have a result. Returns its name, or "" if there is none; then no picture is
/// written. Throws InputError if the file cannot be written or a cloud cannot be read.
std::string draw_before_after(const Experiment& experiment, const std::vector<Scene>& scenes,
                              const std::vector<TrialRecord>& records,
                              const std::filesystem::path& path);

}  // namespace croon::experiments
