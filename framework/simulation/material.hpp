#pragma once

#include <cstdint>

#include "framework/picture/colour.hpp"

namespace croon::simulation {

/// What a surface is made of; decides how much light it sends back.
enum class Material : std::uint8_t {
  asphalt,
  marking,
  concrete,
  paving,
  grass,
  brick,
  plaster,
  glass,
  metal,
  paint,
  white_paint,
  black_paint,
  blue_paint,
  rubber,
  bark,
  leaf,
  cloth,
  wood,
  sign
};

/// How a material looks to a LiDAR and in a picture.
struct MaterialLook {
  double reflectivity = 0.0;  ///< Share of near-infrared light that a Lambertian surface scatters.
  double retroreflection = 0.0;  ///< Share that goes straight back whatever the angle.
  Colour colour;
};

/// The look of `material`. Reflectivities are those of 905 nm in the ranges that makers of LiDARs
/// and of street furniture quote.
const MaterialLook& look_of(Material material);

}  // namespace croon::simulation
