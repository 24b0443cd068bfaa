#pragma once

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The offset that converts times from `min_s` to `max_s`, of a scan with the stamp `stamp_s`, to
/// the clock of the stamp: the stamp if all times are less than 10 s from zero, as with Ouster,
/// Velodyne and nebula; otherwise 0, as with Hesai, RoboSense and Livox, whose times are absolute.
/// If the clock started less than 10 s ago, the distance of the stamp from the times decides.
double time_offset_s(double min_s, double max_s, double stamp_s);

/// Converts the channel `time`, if present, to seconds on the clock of `stamp_s` in double
/// precision; `unit_of_times` determines its unit. Non-finite numbers are kept.
void convert_times(PointCloud& cloud, double stamp_s);

}  // namespace croon
