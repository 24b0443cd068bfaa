#pragma once

#include <filesystem>
#include <ostream>

#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// What `croon simulate` is asked for.
struct SimulateOptions {
  std::filesystem::path experiment;
  std::filesystem::path out;  ///< The folder of the dataset.
  int jobs = 0;               ///< 0: all cores.
  bool png = false;           ///< Draw each scene.
  bool quiet = false;         ///< No progress.
};

/// Writes the scenes of the experiment's dataset, which must be one that can be measured anew, in
/// the layout of the paper's authors: clouds as binary PCD, lists, `truth.json`,
/// `scene_kinds.json`, and `experiment.json`, which runs on them to the same results. Scenes that
/// are there whole are left as they are; a folder that holds anything else is refused. Tells what
/// it wrote in `out` and how far it is in `progress`. Returns 0. Throws InputError, before anything
/// is written where the request is wrong.
int simulate_command(const SimulateOptions& options, const Catalogue& catalogue, std::ostream& out,
                     std::ostream& progress);

}  // namespace croon::experiments
