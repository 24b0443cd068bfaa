#include "framework/picture/cloud_view.hpp"

#include <cmath>

#include "framework/base/text.hpp"
#include "framework/picture/writers.hpp"

namespace croon {

Eigen::Vector3i CloudView::axes() const {
  if (from == ViewFrom::top) return {0, 1, 2};
  return from == ViewFrom::front ? Eigen::Vector3i{1, 2, 0} : Eigen::Vector3i{0, 2, 1};
}

Image CloudView::image() const {
  return {static_cast<int>(std::lround(2.0 * half_width_m / pixel_m)),
          static_cast<int>(std::lround(2.0 * half_height_m / pixel_m))};
}

Image draw_view(const std::vector<ColouredCloud>& clouds, const CloudView& view) {
  Image image = view.image();
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const Colour colour = sensor_colour(i);
    for_each_pixel(transformed(clouds[i].points, clouds[i].T_reference_sensor), view, image,
                   [&](int x, int y) {
                     for (int dot = 0; dot < view.dot_px * view.dot_px; ++dot) {
                       const int right = x + dot % view.dot_px, down = y + dot / view.dot_px;
                       if (image.contains(right, down)) image.at(right, down) = colour;
                     }
                   });
  }
  return image;
}

double scale_bar_m(double width_m) {
  const double max_length_m = width_m / 4.0;
  const double power = std::pow(10.0, std::floor(std::log10(max_length_m)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= max_length_m) return digit * power;
  }
  return power;
}

Image with_legend(const std::vector<Image>& views, const std::vector<std::string>& captions,
                  const std::vector<std::string>& sensors, double pixel_m) {
  constexpr int kGap_px = 8;
  constexpr int kStrip_px = 48;
  constexpr double kScale = 2.0;  // The pictures are large, so their text must be too.
  Image image = padded(side_by_side(views, kGap_px), kStrip_px, kStrip_px);
  Drawing drawing(image.width() / kScale, image.height() / kScale);
  const double text = drawing.sheet().text();
  const double head = 0.65 * kStrip_px / kScale;
  double left = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    drawing.text((left + views[i].width() / 2.0) / kScale, head, captions[i], Anchor::middle,
                 "name");
    left += views[i].width() + kGap_px;
  }
  const double line = drawing.height() - kStrip_px / kScale + head;
  double x = text;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    drawing.rectangle(x, line - 0.8 * text, 0.8 * text, 0.8 * text,
                      "s" + std::to_string(i % kSeriesColours));
    drawing.text(x + 1.2 * text, line, sensors[i], Anchor::start, "name");
    x += 2.4 * text + text_width(sensors[i], text);
  }
  const double bar_m = scale_bar_m(views.front().width() * pixel_m);
  const double bar = bar_m / pixel_m / kScale;
  const double right = drawing.width() - text;
  drawing.rectangle(right - bar, line - 0.4 * text, bar, 3.0, "bar");
  drawing.text(right - bar - 0.5 * text, line, shortest_number(bar_m) + " m", Anchor::end, "name");
  draw_on(image, drawing, kScale);
  return image;
}

}  // namespace croon
