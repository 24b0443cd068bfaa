#pragma once

#include <ostream>

#include "experiments/run/run_request.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// What `croon run` is asked for.
struct RunOptions : RunRequest {
  bool plan = false;      ///< Tell what there is to do, and do nothing.
  bool no_share = false;  ///< Run the variants one by one.
  bool fresh = false;     ///< Delete what is there and start over.
  bool quiet = false;     ///< No progress.
  bool colours = false;   ///< Colours in the table.
  bool clouds = false;    ///< Write fused clouds.
  bool png = false;       ///< Draw a scene before and after.
};

/// Runs the experiment, or what of it is missing, and writes the results: the table to `out`,
/// progress to `progress`. Returns the exit code: 0, or 3 where something in it failed. Throws
/// InputError, before anything is written where the request is wrong.
int run_command(const RunOptions& options, const Catalogue& catalogue, std::ostream& out,
                std::ostream& progress);

}  // namespace croon::experiments
