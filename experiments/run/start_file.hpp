#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"

namespace croon::experiments {

/// The first line of a file of starts. Each line after it is a start `T_reference_sensor`.
inline constexpr const char* kStartHeader = "scene,sensor,trial,tx_m,ty_m,tz_m,qx,qy,qz,qw";

/// Reads the starts in the file `path`: for every sensor of `scenes` trials 0 to n - 1, in any
/// order. Strict: throws one InputError with the first faults of the file.
StartTable read_start_file(const std::filesystem::path& path, const std::vector<Scene>& scenes);

}  // namespace croon::experiments
