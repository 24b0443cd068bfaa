#include "framework/picture/top_view.hpp"

#include <cmath>

#include "framework/picture/colour.hpp"

namespace croon {
namespace {

void draw(Image& image, const PointCloud& points, const TopView& view, Colour colour) {
  for (const Eigen::Vector3f& point : points) {
    const double right = (static_cast<double>(point.x()) + view.half_width_m) / view.pixel_m;
    const double down = (view.half_height_m - static_cast<double>(point.y())) / view.pixel_m;
    if (right < 0.0 || down < 0.0 || right >= image.width() || down >= image.height()) continue;
    image.at(static_cast<int>(right), static_cast<int>(down)) = colour;
  }
}

}  // namespace

Image top_view(const std::vector<ColouredCloud>& clouds, const TopView& view) {
  Image image(static_cast<int>(std::lround(2.0 * view.half_width_m / view.pixel_m)),
              static_cast<int>(std::lround(2.0 * view.half_height_m / view.pixel_m)));
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    draw(image, transformed(clouds[i].points, clouds[i].T_reference_sensor), view,
         sensor_colour(i));
  }
  return image;
}

}  // namespace croon
