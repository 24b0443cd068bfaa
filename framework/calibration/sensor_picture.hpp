#pragma once

#include <optional>
#include <string>

#include "framework/calibration/sensor_views.hpp"
#include "framework/picture/image.hpp"

namespace croon {

/// One sensor and the reference, to be drawn.
struct SensorPicture {
  std::string reference, sensor, note;
  const Points* reference_points = nullptr;     ///< In the level frame.
  const Points* sensor_points = nullptr;        ///< In the sensor's frame.
  std::optional<RigidTransform> before, after;  ///< T_reference_sensor; at least one of them.
  bool is_accepted = true;
  LevelFrame level;
};

/// The sensor and the reference from above and in two sections, before and after, with a legend;
/// pixels with points of both are black. The zoom is chosen from the points of the sensor.
Image draw_sensor(const SensorPicture& picture);

}  // namespace croon
