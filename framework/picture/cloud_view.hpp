#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "framework/picture/colour.hpp"
#include "framework/picture/image.hpp"

namespace croon {

/// The viewpoint: from above (x to the right, y up), from the front (y to the right, z up), from
/// the right side (x to the right, z up).
enum class ViewFrom { top, front, side };

/// The section of the reference's frame that a picture shows.
struct CloudView {
  double half_width_m = 30.0;
  double half_height_m = 20.0;
  double pixel_m = 0.05;
  ViewFrom from = ViewFrom::top;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  /// Points farther from the centre than this along the line of sight are not drawn.
  double half_depth_m = std::numeric_limits<double>::infinity();
  int dot_px = 1;  ///< The width of the square that `draw_view` draws for a point.

  /// The axes to the right, up, and along the line of sight.
  Eigen::Vector3i axes() const;
  /// A white picture of the view's size.
  Image image() const;
};

/// Calls `mark(x, y)` with the pixel of each point in the view; `points` are in the frame of the
/// view.
template <class Mark>
void for_each_pixel(const Points& points, const CloudView& view, const Image& image,
                    const Mark& mark) {
  const Eigen::Vector3i axes = view.axes();
  const auto left_m = static_cast<float>(view.centre_m(axes.x()) - view.half_width_m);
  const auto top_m = static_cast<float>(view.centre_m(axes.y()) + view.half_height_m);
  const auto depth_m = static_cast<float>(view.centre_m(axes.z()));
  const auto half_depth_m = static_cast<float>(view.half_depth_m);
  const auto pixel_m = static_cast<float>(view.pixel_m);
  const auto width = static_cast<float>(image.width());
  const auto height = static_cast<float>(image.height());
  for (const Eigen::Vector3f& point : points) {
    const float right = (point(axes.x()) - left_m) / pixel_m;
    const float down = (top_m - point(axes.y())) / pixel_m;
    // Also false for NaN.
    const bool is_inside = right >= 0.0F && down >= 0.0F && right < width && down < height &&
                           std::abs(point(axes.z()) - depth_m) <= half_depth_m;
    if (is_inside) mark(static_cast<int>(right), static_cast<int>(down));
  }
}

/// The clouds in the reference's frame, each in the colour of its index in `clouds`; later clouds
/// are drawn over earlier ones.
Image draw_view(const std::vector<ColouredCloud>& clouds, const CloudView& view = {});

/// The views side by side, each below its caption; below them a legend of the sensors, in the order
/// of their clouds, and a bar of a round number of metres.
Image with_legend(const std::vector<Image>& views, const std::vector<std::string>& captions,
                  const std::vector<std::string>& sensors, double pixel_m);

/// The length of that bar: 1, 2 or 5 times a power of ten, at most a quarter of `width_m`.
double scale_bar_m(double width_m);

}  // namespace croon
