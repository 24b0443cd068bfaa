#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/store/input_files.hpp"
#include "experiments/store/store_header.hpp"

namespace croon::experiments {

/// The current time, "2024-05-01T12:00:00Z".
std::string utc_time();

/// Everything that determines the result of a trial except its pipeline: dataset, inputs (files and
/// the rig's poses), starts (but not their number), seed and success bounds. The versions of stages
/// are stored separately, see versions_of.
Provenance provenance_of(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                         const std::vector<InputFile>& inputs);

/// The header of the store of a run of this build; `manifest` comes from manifest_json.
StoreHeader header_of(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                      const Provenance& provenance, const std::string& manifest);

/// The JSON description of a run: the experiment with all defaults, the files that it was read
/// from, digests of the inputs, `planned` (the number of trials of the complete experiment) and, if
/// there are any, `sensors_without_truth`. `provenance` has the digests of everything that
/// determines results, including the rig's poses. manifest_with_builds adds the builds.
std::string manifest_json(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                          const std::vector<InputFile>& inputs, const Provenance& provenance);

/// The number of trials of the experiment of a manifest, and of each of its variants. Throw
/// std::exception if the manifest is damaged.
std::size_t planned_trials(const std::string& manifest);
std::size_t planned_trials_of_variant(const std::string& manifest);

/// The sensors of a manifest without ground truth in any scene; none for manifests written before
/// these were recorded. Throws std::exception if the manifest is damaged.
std::set<std::string> sensors_without_truth(const std::string& manifest);

/// The manifest with only the current ones of `variants`.
std::string manifest_with_variants(const std::string& manifest,
                                   const std::vector<StoredName>& variants);

/// The bytes of manifest.json: `manifest` with `host`, the machine and time of the run. Two runs of
/// the same experiment differ only in `host`.
std::string manifest_with_host(const std::string& manifest, const std::filesystem::path& data_root,
                               int jobs);

/// A JSON list of the `host`s of the manifest.json of `folders`; folders without one are skipped.
/// Throws InputError if one is not a file, or damaged.
std::string hosts_json(const std::vector<std::filesystem::path>& folders);

/// The bytes of manifest.json of merged results: `manifest` with `hosts`, see hosts_json.
std::string merged_manifest(const std::string& manifest, const std::string& hosts);

}  // namespace croon::experiments
