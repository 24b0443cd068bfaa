#pragma once

#include <string>
#include <utility>
#include <vector>

namespace croon::experiments {

/// The version of croon, "0.1.0".
const char* croon_version();

/// The commit of this build, followed by "-dirty" if files differed; "unknown" outside a
/// repository.
const char* croon_commit();

/// The compiler and the libraries of this build with their versions.
const std::vector<std::pair<std::string, std::string>>& library_versions();

/// A folder of stages from outside the tree (CROON_EXTRA_STAGES).
struct StageFolder {
  std::string folder;
  std::string commit;  ///< Like croon_commit(), of the repository of the folder.
};

/// The folders of stages from outside the tree in this build.
const std::vector<StageFolder>& stage_folders();

}  // namespace croon::experiments
