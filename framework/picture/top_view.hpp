#pragma once

#include <vector>

#include "framework/picture/colour.hpp"
#include "framework/picture/image.hpp"

namespace croon {

/// What of the reference's frame a picture shows: x to the right, y up.
struct TopView {
  double half_width_m = 30.0;
  double half_height_m = 20.0;
  double pixel_m = 0.05;
};

/// The clouds in the reference's frame seen from above, each in the colour of its place in
/// `clouds`; later ones over earlier ones.
Image top_view(const std::vector<ColouredCloud>& clouds, const TopView& view = {});

}  // namespace croon
