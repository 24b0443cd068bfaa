#pragma once

#include "framework/base/scalar_type.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// How the numbers in a field of times become seconds on the clock of the message's stamp:
/// `offset_s + unit_s * number`.
struct TimeRule {
  double unit_s = 1.0;    ///< 1, 1e-3, 1e-6 or 1e-9.
  double offset_s = 0.0;  ///< The message's stamp if the numbers are relative to it, else 0.
};

/// The rule for times from `min` to `max`, both finite, of a scan that is stamped `stamp_s`.
/// - Numbers as large as the time since 1970 in s, ms, us or ns are that (Hesai, RoboSense: s;
///   Livox: ns in a double).
/// - Else the unit is that in which a scan takes between 3 ms and 3 s, or, if it takes less,
///   seconds for floating numbers (Velodyne) and nanoseconds for integers (Ouster, nebula).
/// - The numbers are relative to the stamp if they are less than 10 s, unless they are as near to
///   the stamp itself (a clock that counts from the start of the sensor).
TimeRule time_rule(ScalarType type, double min, double max, double stamp_s);

/// Replaces the channel `time`, if the cloud has it with one number per point, by seconds in double
/// precision according to `time_rule`. Numbers that are not finite stay.
void convert_times(PointCloud& cloud, double stamp_s);

}  // namespace croon
