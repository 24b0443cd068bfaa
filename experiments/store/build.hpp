#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/store/version.hpp"

namespace croon::experiments {

/// A build of the program: what it was made from. It is information. Whether trials of two builds
/// go into one store is decided by the versions that stages and the framework declare.
struct Build {
  std::string version;  ///< croon's, "0.1.0".
  std::string commit;
  std::string program_sha256;              ///< Of the program, or of the Python module.
  std::vector<StageFolder> stage_folders;  ///< Of stages from outside the tree.
  std::vector<std::pair<std::string, std::string>> libraries;
};

/// Begins to digest the program on a thread of its own; this takes as long as reading a scan.
void begin_this_build();
/// The build that is running.
Build this_build();

/// The versions of all stages that the experiment uses, and that of the framework.
params::StageVersions versions_of(const Experiment& experiment);

/// Both lists, each build once, in an order that depends on the builds alone.
std::vector<Build> united(std::vector<Build> a, const std::vector<Build>& b);

bool is_same(const std::vector<Build>& a, const std::vector<Build>& b);

/// JSON of the list, and its reader, which throws std::exception if the text is damaged.
std::string builds_json(const std::vector<Build>& builds);
std::vector<Build> read_builds(const std::string& text);

/// JSON of the versions, and its reader, likewise.
std::string versions_json(const params::StageVersions& versions);
params::StageVersions read_versions(const std::string& text);

/// The JSON of a manifest with the builds and versions in it: "croon" and "libraries" are those of
/// the first build, and "builds" lists all if there are several.
std::string manifest_with_builds(const std::string& manifest, const std::vector<Build>& builds,
                                 const params::StageVersions& versions);

}  // namespace croon::experiments
