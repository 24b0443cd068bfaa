#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/engine/provenance.hpp"

namespace croon::experiments {

/// The bytes of manifest.json: the experiment with every default, versions, digests of the inputs
/// (`provenance` those of everything that decides results, the rig's poses too), and `host`: where
/// and when this was run, the only member that differs between two runs of the same thing.
std::string manifest_json(const Experiment& experiment, const std::vector<InputFile>& inputs,
                          const Provenance& provenance, const std::filesystem::path& data_root,
                          int jobs);

}  // namespace croon::experiments
