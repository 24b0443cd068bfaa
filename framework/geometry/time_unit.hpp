#pragma once

#include <cstddef>
#include <vector>

#include "framework/base/scalar_type.hpp"

namespace croon {

/// Bounds for the duration of a scan, seconds: a revolution takes 0.05 to 0.2 s, and a non-rotating
/// LiDAR accumulates points for a few seconds.
inline constexpr double kMinScan_s = 5e-4;
inline constexpr double kMaxScan_s = 10.0;
/// Fewer points may be any part of a scan, so kMinScan_s does not apply to them.
inline constexpr std::size_t kMinPointsOfScan = 1000;

enum class TimeUnit { seconds, milliseconds, microseconds, nanoseconds };

/// 1e-9 for nanoseconds.
double seconds_of(TimeUnit unit);
/// "microseconds".
const char* name_of(TimeUnit unit);

/// Seconds for floating-point numbers, nanoseconds for integers.
TimeUnit convention_of(ScalarKind kind);

/// The unit of the times of one scan, stored as numbers of this kind. Times since 1970 reveal their
/// unit by their magnitude (Livox writes such nanoseconds as double). Other times have the
/// conventional unit if it implies a possible duration of a scan, otherwise the unit for which the
/// duration is closest to 0.1 s, if any unit implies a possible one. Times that are not finite are
/// ignored.
TimeUnit unit_of_times(const std::vector<double>& times, ScalarKind kind);

/// Whether times are relative to a packet of the sensor instead of the scan: they restart many
/// times, in the order of the file, and a packet is much shorter than any scan.
bool restart_in_packets(const std::vector<double>& times, ScalarKind kind);

}  // namespace croon
