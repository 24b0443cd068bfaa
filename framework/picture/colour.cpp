#include "framework/picture/colour.hpp"

#include <array>

namespace croon {

Colour sensor_colour(std::size_t index) {
  static const std::array<Colour, 8> colours = {{{153, 153, 153},
                                                 {230, 159, 0},
                                                 {86, 180, 233},
                                                 {0, 158, 115},
                                                 {240, 228, 66},
                                                 {0, 114, 178},
                                                 {213, 94, 0},
                                                 {204, 121, 167}}};
  return colours[index % colours.size()];
}

std::string hex_text(const Colour& colour) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const int byte : {colour.red, colour.green, colour.blue}) {
    text += {kDigits[byte / 16], kDigits[byte % 16]};
  }
  return text;
}

}  // namespace croon
