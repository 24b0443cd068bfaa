#include "experiments/report/rig_view_pictures.hpp"

#include <algorithm>

#include "framework/base/text.hpp"
#include "framework/picture/cloud_view.hpp"

namespace croon::experiments {
namespace {

/// The picture of `shown` at the first and the last state, side by side.
std::string before_and_after(const RigView& view, const CloudView& shown) {
  std::vector<Image> images;
  std::vector<std::string> captions, names;
  const std::size_t last = view.states.size() - 1;
  for (std::size_t state = 0; state <= last; state += std::max<std::size_t>(last, 1)) {
    std::vector<ColouredCloud> clouds;
    for (const ViewedSensor& sensor : view.sensors) {
      // A sensor without a pose keeps its colour.
      const bool has_pose = sensor.poses[state].has_value();
      clouds.push_back({sensor.sensor, has_pose ? sensor.points : Points(),
                        sensor.poses[state].value_or(RigidTransform())});
    }
    images.push_back(draw_view(clouds, shown));
    captions.push_back((state == last ? "after: " : "before: ") + view.states[state]);
  }
  for (const ViewedSensor& sensor : view.sensors) {
    names.push_back(cut_in_the_middle(printable(sensor.sensor), 12));
  }
  return png_bytes(with_legend(images, captions, names, shown.pixel_m));
}

}  // namespace

Picture overview_picture(const RigView& view) {
  CloudView shown = {25.0, 25.0, 0.1};
  shown.dot_px = 2;
  return {"", "The clouds from above, before and after", before_and_after(view, shown)};
}

FigureRow close_up_row(const RigView& view) {
  FigureRow row;
  for (const CloseUp& place : view.close_ups) {
    CloudView shown = {place.half_width_m, place.half_width_m, 0.01};
    shown.centre_m = place.centre_m;
    shown.dot_px = 5;
    row.figures.emplace_back(
        Picture{place.title, "Close-up of a " + place.title + ", from above, before and after",
                before_and_after(view, shown)});
  }
  return row;
}

}  // namespace croon::experiments
