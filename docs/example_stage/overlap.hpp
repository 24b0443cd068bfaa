#pragma once

#include "framework/stage/extras.hpp"

namespace croon {

/// The share of the sensor's cells that the reference occupies too. overlap_alignment gives it.
inline constexpr Extra<double> kOverlap{"overlap_ratio", "the share of cells that both occupy"};

}  // namespace croon
