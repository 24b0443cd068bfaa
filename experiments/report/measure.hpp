#pragma once

#include <array>
#include <cstddef>

#include "framework/geometry/pose_error.hpp"

namespace croon::experiments {

/// One number that is measured of a pose against another, in the unit that reports use.
struct Measure {
  const char* name;  ///< "roll", as in the column `roll_error_deg`.
  const char* unit;  ///< "deg" or "m".
};

/// The six DOFs in the order of `Vector6d`, then the two distances.
inline constexpr std::array<Measure, 8> kMeasures = {{{"roll", "deg"},
                                                      {"pitch", "deg"},
                                                      {"yaw", "deg"},
                                                      {"x", "m"},
                                                      {"y", "m"},
                                                      {"z", "m"},
                                                      {"rotation", "deg"},
                                                      {"translation", "m"}}};

/// The measures that are DOFs come first.
inline constexpr std::size_t kDofs = 6;

/// The DOFs as the paper's tables order them: pitch, roll, yaw, x, y, z.
inline constexpr std::array<std::size_t, kDofs> kPaperOrder = {1, 0, 2, 3, 4, 5};

/// One number per measure, in their order and units.
using Measures = std::array<double, kMeasures.size()>;

/// `error` in the units of `kMeasures`.
Measures measures_of(const PoseError& error);

}  // namespace croon::experiments
