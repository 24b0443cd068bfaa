#pragma once

#include <vector>

#include "framework/picture/colour.hpp"
#include "framework/picture/image.hpp"

namespace croon {

/// The section of the reference's frame that a picture shows: x to the right, y up.
struct TopView {
  double half_width_m = 30.0;
  double half_height_m = 20.0;
  double pixel_m = 0.05;
};

/// The clouds in the reference's frame seen from above, each in the colour of its index in
/// `clouds`; later clouds are drawn over earlier ones.
Image top_view(const std::vector<ColouredCloud>& clouds, const TopView& view = {});

}  // namespace croon
