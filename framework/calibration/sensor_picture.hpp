#pragma once

#include <optional>
#include <string>

#include "framework/calibration/sensor_views.hpp"
#include "framework/picture/image.hpp"

namespace croon {

/// The data for the picture of one sensor and the reference.
struct SensorPicture {
  std::string reference, sensor, note;
  const Points* reference_points = nullptr;     ///< In the level frame.
  const Points* sensor_points = nullptr;        ///< In the sensor's frame.
  std::optional<RigidTransform> before, after;  ///< T_reference_sensor; at least one of them.
  bool is_accepted = true;
  LevelFrame level;
};

/// Draws the sensor and the reference from above and in two sections, before and after, with a
/// legend; pixels with points of both are black. The points of the sensor determine the zoom.
Image draw_sensor(const SensorPicture& picture);

}  // namespace croon
