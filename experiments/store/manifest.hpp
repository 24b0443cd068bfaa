#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/store/provenance.hpp"

namespace croon::experiments {

/// JSON of what was run: the experiment with every default, the files that it was read from,
/// versions, digests of the inputs, and `planned`, the number of trials of the whole experiment.
/// `provenance` has the digests of everything that decides results, also of the rig's poses.
std::string manifest_json(const Experiment& experiment, const std::vector<Scene>& scenes,
                          const std::vector<InputFile>& inputs, const Provenance& provenance);

/// The number of trials of the experiment of a manifest.
std::size_t planned_trials(const std::string& manifest);

/// The manifest with those of `variants` that are current.
std::string manifest_with_variants(const std::string& manifest,
                                   const std::vector<StoredName>& variants);

/// The bytes of manifest.json: `manifest` with `host`, which says where and when it was run. Two
/// runs of the same experiment differ in `host` only.
std::string manifest_with_host(const std::string& manifest, const std::filesystem::path& data_root,
                               int jobs);

/// The bytes of manifest.json of results that were merged from `folders`; `host` lists theirs.
std::string merged_manifest(const std::string& manifest,
                            const std::vector<std::filesystem::path>& folders);

}  // namespace croon::experiments
