#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// Red, green, blue.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// "#0072b2".
std::string hex_text(const Colour& colour);

/// The colour of the sensor `index`, the reference being 0: grey, then the palette of Okabe and Ito
/// (2008), which colour-blind readers can distinguish; it repeats after eight.
Colour sensor_colour(std::size_t index);

/// One sensor's cloud in its own frame, to be drawn in the reference's frame.
struct ColouredCloud {
  std::string sensor;
  Points points;
  RigidTransform T_reference_sensor;
};

}  // namespace croon
