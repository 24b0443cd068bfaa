#pragma once

#include <filesystem>

#include "experiments/file/experiment.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// The experiment that the JSON file `path` describes (DESIGN.md, section 4), with its stages from
/// `catalogue`. Strict: throws one InputError with every fault of the file. Does not look at the
/// data.
Experiment load_experiment(const std::filesystem::path& path, const Catalogue& catalogue);

}  // namespace croon::experiments
