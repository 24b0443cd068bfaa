#include <algorithm>
#include <cmath>

#include "experiments/report/rig_charts.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

constexpr double kNodeWidth = 120.0, kNodeHeight = 40.0;

/// The centres of the nodes, on an ellipse, so that no edge passes through a third node. The
/// reference is at the top.
std::vector<Corner> node_centres(std::size_t count, double width, double height) {
  std::vector<Corner> centres;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(count);
    centres.push_back({width / 2.0 + 0.41 * width * std::sin(angle),
                       height / 2.0 - 0.43 * height * std::cos(angle)});
  }
  return centres;
}

std::size_t index_of_sensor(const RigView& view, const std::string& sensor) {
  const auto found = std::find_if(view.sensors.begin(), view.sensors.end(),
                                  [&](const ViewedSensor& one) { return one.sensor == sensor; });
  return static_cast<std::size_t>(found - view.sensors.begin());
}

void draw_node(Drawing& drawing, const Corner& centre, const ViewedSensor& sensor) {
  const bool is_good = sensor.is_accepted && !is_contradicted(sensor);
  const std::string colour = sensor.is_reference ? "c7" : is_good ? "c2" : "c1";
  const double left = centre[0] - kNodeWidth / 2.0, top = centre[1] - kNodeHeight / 2.0;
  drawing.rectangle(left, top, kNodeWidth, kNodeHeight, "page");
  drawing.rectangle(left, top, kNodeWidth, kNodeHeight, "box " + colour + (is_good ? "" : " d1"));
  drawing.text(centre[0], centre[1] - 3.0, cut_in_the_middle(printable(sensor.sensor), 15),
               Anchor::middle, "name");
  const char* const verdict = sensor.is_reference   ? "reference"
                              : !sensor.is_accepted ? "REJECTED"
                              : is_good             ? "accepted"
                                                    : "CONTRADICTED";
  drawing.text(centre[0], centre[1] + 13.0, verdict, Anchor::middle, "small");
}

}  // namespace

Drawing sensor_graph(const RigView& view, const Sheet& sheet) {
  const double width = sheet.width > 0.0 ? sheet.width : 760.0;
  const double height = 0.5 * width;
  Drawing drawing(width, height, sheet);
  drawing.describe("The graph of sensors: overlap and median distance of each pair");
  drawing.rectangle(0.0, 0.0, width, height, "page");
  const std::vector<Corner> centres = node_centres(view.sensors.size(), width, height);
  for (const bool is_text : {false, true}) {
    for (const SensorAgreement& pair : view.pairs) {
      const std::size_t a = index_of_sensor(view, pair.a), b = index_of_sensor(view, pair.b);
      const bool is_accepted = view.sensors[a].is_accepted && view.sensors[b].is_accepted;
      const Corner from = centres[a], to = centres[b];
      if (!is_text) {
        drawing.line(from[0], from[1], to[0], to[1], is_accepted ? "curve c7" : "curve c1 d1");
        continue;
      }
      // Off the middle, where many edges cross.
      const double x = from[0] + 0.36 * (to[0] - from[0]), y = from[1] + 0.36 * (to[1] - from[1]);
      const std::string label = fixed_number(100.0 * pair.overlap_ratio, 0) + " %, " +
                                fixed_number(1e3 * pair.median_distance_m, 0) + " mm";
      const double text = sheet.small();
      const double label_width = text_width(label, text);
      drawing.rectangle(x - label_width / 2.0, y - text, label_width, 1.5 * text, "page");
      drawing.text(x, y + 0.2 * text, label, Anchor::middle, "small");
    }
  }
  for (std::size_t i = 0; i < view.sensors.size(); ++i) {
    draw_node(drawing, centres[i], view.sensors[i]);
  }
  return drawing;
}

}  // namespace croon::experiments
