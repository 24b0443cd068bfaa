#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/report/experiment_report.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// The views of the trials that a reader should look at: the accepted pose with the largest error,
/// a typical accepted pose, a rejected and a failed trial with a pose. Loads their clouds, from the
/// data root or by simulation. Throws InputError if the clouds are not there or have changed.
std::vector<TrialView> trial_views(const Results& results, const std::filesystem::path& data_root,
                                   const Catalogue& catalogue);

}  // namespace croon::experiments
