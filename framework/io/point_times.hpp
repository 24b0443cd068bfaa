#pragma once

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// What times from `min_s` to `max_s` of a scan that is stamped `stamp_s` lack to be on the clock
/// of the stamp: the stamp, if all are less than 10 s from zero, as Ouster, Velodyne and nebula
/// write them; else 0, as for Hesai, RoboSense and Livox, whose times are absolute. Stamps of a
/// clock that started less than 10 s ago are told by their own distance to the times.
double time_offset_s(double min_s, double max_s, double stamp_s);

/// Replaces the channel `time`, if the cloud has it, by seconds on the clock of `stamp_s` in double
/// precision; the unit is that of `unit_of_times`. Numbers that are not finite stay.
void convert_times(PointCloud& cloud, double stamp_s);

}  // namespace croon
