#pragma once

#include <ostream>

#include "experiments/cli/calibrate_command.hpp"

namespace croon::experiments {

/// Checks the poses in the file `options.nominal` against the clouds of `options.inputs`, which are
/// read as in calibrate_command. Prints for each sensor whether its pose is right, wrong or
/// undecidable, and how far it is from the optimum, in total and per degree of freedom. Writes no
/// files; progress goes to `err`. Returns 3 unless all poses are right. Throws InputError if the
/// request is wrong.
int check_command(const CalibrateOptions& options, const Catalogue& catalogue, std::ostream& out,
                  std::ostream& err);

}  // namespace croon::experiments
