#pragma once

#include <filesystem>

namespace croon::experiments {

/// The data root: `asked`, or where that is empty the folder CROON_DATA, else data/.
std::filesystem::path data_root(const std::filesystem::path& asked);

}  // namespace croon::experiments
