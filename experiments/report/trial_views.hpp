#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/report/experiment_report.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// The views of the trials called `names` (see trial_name; without the variant, if the results have
/// only one), then of those that a reader should look at: the accepted pose with the largest error,
/// a typical accepted pose, a rejected and a failed trial with a pose. Loads their clouds, from the
/// data root or by simulation. A trial in `names` without a pose is shown at its initial guess and
/// at ground truth. Throws InputError if a trial in `names` is not stored or cannot be shown, with
/// the nearest name or the reason; and if the clouds are not there or have changed.
std::vector<TrialView> trial_views(const Results& results, const std::vector<std::string>& names,
                                   const std::filesystem::path& data_root,
                                   const Catalogue& catalogue);

}  // namespace croon::experiments
