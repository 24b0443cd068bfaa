#pragma once

#include <vector>

#include "framework/geometry/plane.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The size of objects that may be vehicles.
struct VehicleSize {
  double cell_m = 0.4;         ///< Points in neighbouring cells of the ground are one object.
  double min_height_m = 0.3;   ///< Points lower above the ground belong to the ground.
  double max_height_m = 4.5;   ///< An object with a higher point is not a vehicle.
  double min_length_m = 0.8;   ///< A shorter object is a post, a trunk or a person.
  double max_length_m = 14.0;  ///< A longer object is a wall, a rail or a row of parked cars.
  double max_width_m = 4.0;    ///< Likewise across.
  double max_range_m = 40.0;   ///< Along the ground; points farther away are ignored.
};

/// Whether each point belongs to an isolated object of the size of a vehicle, which may be moving:
/// the points above `ground` are sorted into cells of the ground plane, and neighbouring cells form
/// one object.
std::vector<bool> is_vehicle_sized(const Points& points, const Plane& ground,
                                   const VehicleSize& options);

}  // namespace croon
