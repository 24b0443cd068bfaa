#pragma once

#include <Eigen/Core>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The common offset of points in map coordinates, metres: along each axis the median, rounded to
/// whole kilometres, if it is beyond 10 km, otherwise 0.
Eigen::Vector3d common_offset_m(const Points& points);

/// Adds a note that `cloud.origin_m` was subtracted.
void note_common_offset(LoadedCloud& cloud);

/// The cloud that `read` returns. `read` is called with an offset that it must subtract from every
/// point in double precision: zero, and then the common offset if there is one, because a float has
/// steps of 1 mm at 10 km and of 0.5 m at UTM northings.
template <class Read>
LoadedCloud without_common_offset(const Read& read) {
  LoadedCloud cloud = read(Eigen::Vector3d::Zero().eval());
  const Eigen::Vector3d offset_m = common_offset_m(cloud.points);
  if (offset_m.isZero(0.0)) return cloud;
  cloud = read(offset_m);
  note_common_offset(cloud);
  return cloud;
}

/// Makes the channel `time` of `cloud` valid for any subset of the points, and adds a note:
/// converts it to seconds in double precision if its unit is not the conventional one (see
/// `unit_of_times`); renames it to `time_in_packet`, so that it is not used, if its times restart
/// in every packet. The points must be in the order of the sensor.
void check_unit_of_times(LoadedCloud& cloud);

}  // namespace croon
