#pragma once

#include <string>
#include <utility>
#include <vector>

namespace croon::experiments {

/// croon's version, "0.1.0".
const char* croon_version();

/// The commit that this build was configured at, followed by "-dirty" if files differed; "unknown"
/// outside a repository.
const char* croon_commit();

/// The compiler and the libraries of this build with their versions.
const std::vector<std::pair<std::string, std::string>>& library_versions();

}  // namespace croon::experiments
