#pragma once

#include <string>
#include <utility>
#include <vector>

namespace croon::experiments {

/// croon's version, "0.1.0".
const char* croon_version();

/// The commit that this build was made from, followed by "-dirty" if files differed; "unknown"
/// outside a repository.
const char* croon_commit();

/// The compiler and the libraries of this build with their versions.
const std::vector<std::pair<std::string, std::string>>& library_versions();

/// A folder of stages from outside the tree (CROON_EXTRA_STAGES).
struct StageFolder {
  std::string folder;
  std::string commit;  ///< As croon_commit(): of the repository that the folder is in.
};

/// The folders of stages from outside the tree that are in this build.
const std::vector<StageFolder>& stage_folders();

}  // namespace croon::experiments
