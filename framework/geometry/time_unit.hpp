#pragma once

#include <cstddef>
#include <vector>

#include "framework/base/scalar_type.hpp"

namespace croon {

/// A scan lasts between these two, seconds: a turn takes 0.05 to 0.2 s, and a LiDAR without turns
/// collects points for a few seconds.
inline constexpr double kMinScan_s = 5e-4;
inline constexpr double kMaxScan_s = 10.0;
/// Fewer points may be any part of a scan, so kMinScan_s does not apply to them.
inline constexpr std::size_t kMinPointsOfScan = 1000;

enum class TimeUnit { seconds, milliseconds, microseconds, nanoseconds };

/// 1e-9 for nanoseconds.
double seconds_of(TimeUnit unit);
/// "microseconds".
const char* name_of(TimeUnit unit);

/// Seconds of floating numbers, nanoseconds of integers.
TimeUnit convention_of(ScalarKind kind);

/// The unit of the times of one scan, which are stored as numbers of this kind. Times since 1970
/// show it by their size (Livox writes such nanoseconds as double). Of other times it is that of
/// the convention if a scan can last that long; else the unit in which the scan lasts closest to
/// 0.1 s, if it can last that long in any. Times that are not finite are ignored.
TimeUnit unit_of_times(const std::vector<double>& times, ScalarKind kind);

/// Whether times are relative to a packet of the sensor instead of the scan: they start again many
/// times, in the order of the file, and a packet is much shorter than any scan.
bool restart_in_packets(const std::vector<double>& times, ScalarKind kind);

}  // namespace croon
