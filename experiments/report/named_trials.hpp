#pragma once

#include <string>
#include <vector>

#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// The option of `croon report` that names a trial.
inline constexpr const char* kTrialOption = "--trial";

/// The stored trials called `names`, each once, in the order of `names`. A name is `trial_name`, or
/// without the variant if all records have the same one. Names of variants, scenes and sensors may
/// contain slashes, so whole names are compared; a name of several trials means all of them. Throws
/// InputError with the nearest name for each name that no trial has.
std::vector<const TrialRecord*> trials_called(const std::vector<std::string>& names,
                                              const std::vector<TrialRecord>& records);

}  // namespace croon::experiments
