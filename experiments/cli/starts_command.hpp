#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// What `croon starts` is asked for.
struct StartsOptions {
  std::filesystem::path experiment;
  std::filesystem::path out;   ///< The file to write; empty: standard output.
  std::filesystem::path data;  ///< The data root; see `data_root`.
  int trials = 0;              ///< 0: those of the experiment.
};

/// The bytes of a file of the starts, by scene, sensor and trial; `resolve_starts` is done.
std::string starts_csv(const Experiment& experiment, const std::vector<Scene>& scenes);

/// Writes the starts of the experiment, by scene, sensor and trial, as a CSV file that an
/// experiment can name in "starts": with it the trials come out the same to the last bit. Returns
/// 0. Throws InputError.
int starts_command(const StartsOptions& options, const Catalogue& catalogue, std::ostream& out);

}  // namespace croon::experiments
