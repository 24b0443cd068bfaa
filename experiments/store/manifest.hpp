#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/store/input_files.hpp"
#include "experiments/store/store_header.hpp"

namespace croon::experiments {

/// Everything that decides the result of a trial except its pipeline: dataset, inputs (files and
/// the rig's poses), starts (but not their number), seed and success bounds. Versions of stages are
/// beside it, see versions_of.
Provenance provenance_of(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                         const std::vector<InputFile>& inputs);

/// The header of the store of a run of this build; `manifest` comes from manifest_json.
StoreHeader header_of(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                      const Provenance& provenance, const std::string& manifest);

/// JSON of what was run: the experiment with every default, the files that it was read from,
/// digests of the inputs, `planned`, the number of trials of the whole experiment, and
/// `sensors_without_truth`, if there are any.
/// `provenance` has the digests of everything that decides results, also of the rig's poses. What
/// the builds say is added by manifest_with_builds.
std::string manifest_json(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                          const std::vector<InputFile>& inputs, const Provenance& provenance);

/// The number of trials of the experiment of a manifest, and that of each of its variants. Throw
/// std::exception if the manifest is damaged.
std::size_t planned_trials(const std::string& manifest);
std::size_t planned_trials_of_variant(const std::string& manifest);

/// The sensors of a manifest of which no scene has the truth; none for manifests that were written
/// before they said so. Throws std::exception if the manifest is damaged.
std::set<std::string> sensors_without_truth(const std::string& manifest);

/// The manifest with those of `variants` that are current.
std::string manifest_with_variants(const std::string& manifest,
                                   const std::vector<StoredName>& variants);

/// The bytes of manifest.json: `manifest` with `host`, which says where and when it was run. Two
/// runs of the same experiment differ in `host` only.
std::string manifest_with_host(const std::string& manifest, const std::filesystem::path& data_root,
                               int jobs);

/// JSON of the list of the `host`s of the manifest.json of `folders`; a folder without one has
/// none. Throws InputError if one is no file, or damaged.
std::string hosts_json(const std::vector<std::filesystem::path>& folders);

/// The bytes of manifest.json of merged results: `manifest` with `hosts`, see hosts_json.
std::string merged_manifest(const std::string& manifest, const std::string& hosts);

}  // namespace croon::experiments
