#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/geometry/pose_covariance.hpp"

namespace croon {

/// Why a pose was rejected and what would help, in sentences.
struct ReasonsInWords {
  std::vector<std::string> reasons;
  std::vector<std::string> advice;  ///< Without duplicates.
};

/// The sentences for `rejection`, the reasons of steps as an Estimate has them, or a step's
/// failure. A reason that is not in the table becomes a sentence as it is. Degrees of freedom that
/// `covariance` calls unobservable add advice.
ReasonsInWords reasons_in_words(const std::string& rejection,
                                const std::optional<PoseCovariance>& covariance);

}  // namespace croon
