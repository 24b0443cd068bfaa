#pragma once

#include <string>
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

/// The views of `top_view` side by side, each below its caption; below them a legend of the
/// sensors, in the order of their clouds, and a bar of a round number of metres.
Image with_legend(const std::vector<Image>& views, const std::vector<std::string>& captions,
                  const std::vector<std::string>& sensors, double pixel_m);

/// The length of that bar: 1, 2 or 5 times a power of ten, at most a quarter of `width_m`.
double scale_bar_m(double width_m);

}  // namespace croon
