#pragma once

#include <ostream>

#include "experiments/cli/calibrate_command.hpp"

namespace croon::experiments {

/// Judges the poses in the file `options.nominal` by the clouds of `options.inputs`, as
/// calibrate_command reads them: right, wrong or undecidable for each sensor, how far from the
/// optimum, and along which degrees of freedom. Writes no files; progress goes to `err`. Returns 3
/// unless all poses are right. Throws InputError if the request is wrong.
int check_command(const CalibrateOptions& options, const Catalogue& catalogue, std::ostream& out,
                  std::ostream& err);

}  // namespace croon::experiments
