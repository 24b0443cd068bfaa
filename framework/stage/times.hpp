#pragma once

#include <string>

#include "framework/stage/extras.hpp"

namespace croon {

/// Why the times of two clouds were removed.
struct TimesInDoubt {
  std::string reason;  ///< "the cloud of left has no times".
  /// Set if each cloud has usable times, but the clocks or moments of the sensors differ.
  bool are_clocks_apart = false;
};

/// Provided for pairs of clouds whose times cannot be used.
inline constexpr Extra<TimesInDoubt> kTimesInDoubt{"times_in_doubt",
                                                   "why the times of the clouds are not used"};

}  // namespace croon
