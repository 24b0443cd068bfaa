#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/geometry/pose_covariance.hpp"

namespace croon {

/// The advice for a sensor whose common view with the reference is too small.
inline constexpr const char* kMoreSharedView =
    "Record where both sensors see the same walls, poles or parked cars: their common field of "
    "view is small or nearly empty. If they share little view by design, supply nominal poses.";

/// The reasons for a rejection and advice, in sentences.
struct ReasonsInWords {
  std::vector<std::string> reasons;
  std::vector<std::string> advice;  ///< Without duplicates.
};

/// Explains `rejection`: the reasons in an Estimate, or a step's failure. An unknown reason is used
/// as it is. Degrees of freedom that are unobservable in `covariance` add advice.
ReasonsInWords reasons_in_words(const std::string& rejection,
                                const std::optional<PoseCovariance>& covariance);

}  // namespace croon
