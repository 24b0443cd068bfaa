#pragma once

#include <Eigen/Core>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The offset that most of the points of a map have in common, metres: along each axis the median
/// rounded to whole kilometres if it is beyond 10 km, else 0.
Eigen::Vector3d common_offset_m(const Points& points);

/// Adds the note that `cloud.origin_m` was subtracted.
void note_common_offset(LoadedCloud& cloud);

/// The cloud that `read` returns, which is called with the offset that it subtracts from every
/// point in double precision: zero, and again with the common offset if there is one, because a
/// float has steps of 1 mm at 10 km and of 0.5 m at the northings of UTM.
template <class Read>
LoadedCloud without_common_offset(const Read& read) {
  LoadedCloud cloud = read(Eigen::Vector3d::Zero().eval());
  const Eigen::Vector3d offset_m = common_offset_m(cloud.points);
  if (offset_m.isZero(0.0)) return cloud;
  cloud = read(offset_m);
  note_common_offset(cloud);
  return cloud;
}

/// Makes the channel `time` of `cloud` one that any part of the points can be understood by, and
/// adds a note: seconds in double precision if its unit is not that of the convention (see
/// `unit_of_times`); renamed to `time_in_packet`, so that nothing uses it, if its times start again
/// in every packet. The points must be in the order of the sensor.
void check_unit_of_times(LoadedCloud& cloud);

}  // namespace croon
