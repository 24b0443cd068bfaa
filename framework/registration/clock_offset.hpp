#pragma once

namespace croon {

/// Whether `std_s` can be the standard deviation of a clock's offset: 0 for clocks that agree, or a
/// value whose inverse square is finite.
inline bool is_clock_std(double std_s) { return std_s == 0.0 || std_s >= 1e-9; }

inline constexpr const char* kClockStdIs = "clock_offset_std_s must be 0 or at least 1e-9";

}  // namespace croon
