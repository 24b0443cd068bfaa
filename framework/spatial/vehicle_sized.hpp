#pragma once

#include <vector>

#include "framework/geometry/plane.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The size of things that may be vehicles.
struct VehicleSize {
  double cell_m = 0.4;         ///< Points in neighbouring cells of the ground are one thing.
  double min_height_m = 0.3;   ///< Points lower above the ground are of the ground.
  double max_height_m = 4.5;   ///< A thing with a higher point is no vehicle.
  double min_length_m = 0.8;   ///< A shorter thing is a post, a trunk or a person.
  double max_length_m = 14.0;  ///< A longer thing is a wall, a rail or a row of parked cars.
  double max_width_m = 4.0;    ///< Likewise across.
  double max_range_m = 40.0;   ///< Along the ground; points farther away are of no thing.
};

/// Which of the points belong to a thing that stands alone and has the size of a vehicle, so that
/// it may move by itself: those above `ground` are put into cells of the ground plane, and
/// neighbouring cells are one thing.
std::vector<bool> is_vehicle_sized(const Points& points, const Plane& ground,
                                   const VehicleSize& options);

}  // namespace croon
