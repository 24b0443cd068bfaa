#pragma once

#include <cstddef>
#include <cstdint>

namespace croon {

/// Red, green, blue.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// The colour of the sensor `index`, the reference being 0: grey, then the palette of Okabe and Ito
/// (2008), which colour-blind readers can tell apart; it starts again after eight.
Colour sensor_colour(std::size_t index);

}  // namespace croon
