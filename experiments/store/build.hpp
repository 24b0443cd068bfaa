#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/store/version.hpp"

namespace croon::experiments {

/// A build of the program and its sources. For information only: whether trials of two builds may
/// share a store depends on the versions declared by the stages and the framework.
struct Build {
  std::string version;  ///< croon's, "0.1.0".
  std::string commit;
  std::string program_sha256;              ///< Digest of the program or the Python module.
  std::vector<StageFolder> stage_folders;  ///< Folders of stages from outside the tree.
  std::vector<std::pair<std::string, std::string>> libraries;
};

/// Starts digesting the program on another thread; this takes as long as reading a scan.
void begin_this_build();
/// The running build.
Build this_build();

/// The versions of the framework and of all stages that the experiment uses.
params::StageVersions versions_of(const Experiment& experiment);

/// The distinct builds of both lists, in an order that depends only on the builds.
std::vector<Build> united(std::vector<Build> a, const std::vector<Build>& b);

bool is_same(const std::vector<Build>& a, const std::vector<Build>& b);

/// The list as JSON, and its parser, which throws std::exception for damaged text.
std::string builds_json(const std::vector<Build>& builds);
std::vector<Build> read_builds(const std::string& text);

/// The versions as JSON, and their parser, which throws std::exception for damaged text.
std::string versions_json(const params::StageVersions& versions);
params::StageVersions read_versions(const std::string& text);

/// The JSON of a manifest with builds and versions added: "croon" and "libraries" are those of the
/// first build, and "builds" lists all if there are several.
std::string manifest_with_builds(const std::string& manifest, const std::vector<Build>& builds,
                                 const params::StageVersions& versions);

}  // namespace croon::experiments
