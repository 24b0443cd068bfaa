#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/store/provenance.hpp"

namespace croon::experiments {

/// JSON of what was run: the experiment with every default, versions, digests of the inputs
/// (`provenance` those of everything that decides results, the rig's poses too), and `planned`, how
/// many trials the whole experiment has.
std::string manifest_json(const Experiment& experiment, const std::vector<Scene>& scenes,
                          const std::vector<InputFile>& inputs, const Provenance& provenance);

/// How many trials the experiment of a manifest has.
std::size_t planned_trials(const std::string& manifest);

/// The manifest of the same experiment with the `variants` that are current.
std::string manifest_with_variants(const std::string& manifest,
                                   const std::vector<StoredName>& variants);

/// The bytes of manifest.json: `manifest` and `host`, where and when this was run, the only member
/// that differs between two runs of the same thing.
std::string manifest_with_host(const std::string& manifest, const std::filesystem::path& data_root,
                               int jobs);

/// The same of results that were merged from `folders`: `host` lists those of their manifests.
std::string merged_manifest(const std::string& manifest,
                            const std::vector<std::filesystem::path>& folders);

}  // namespace croon::experiments
