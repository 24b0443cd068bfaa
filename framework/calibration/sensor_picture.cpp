#include "framework/calibration/sensor_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "framework/base/text.hpp"
#include "framework/picture/writers.hpp"

namespace croon {
namespace {

constexpr int kGap_px = 8;
constexpr int kCaption_px = 26;
constexpr int kTitle_px = 64;
constexpr int kLegend_px = 36;
constexpr double kTextScale = 1.35;

constexpr Colour kReferenceColour = {0, 114, 178};  // "c0"
constexpr Colour kSensorColour = {230, 159, 0};     // "c4"
constexpr Colour kBothColour = {34, 34, 34};        // "bar"

/// Draws both clouds on `canvas`, with the top left corner at the pixel (left, up).
void draw_panel(Image& canvas, int left, int up, const Points& reference, const Points& sensor,
                const CloudView& view) {
  const Image panel = view.image();
  enum : std::uint8_t { kReference = 1, kSensor = 2 };
  // One more row and column than the panel, for dots of two by two pixels.
  const auto stride = static_cast<std::size_t>(panel.width()) + 1;
  std::vector<std::uint8_t> marks(stride * (static_cast<std::size_t>(panel.height()) + 1), 0);
  const auto mark = [&](std::uint8_t bit) {
    return [&marks, stride, bit](int x, int y) {
      const std::size_t first = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
      for (const std::size_t i : {first, first + 1, first + stride, first + stride + 1}) {
        marks[i] |= bit;
      }
    };
  };
  for_each_pixel(reference, view, panel, mark(kReference));
  for_each_pixel(sensor, view, panel, mark(kSensor));
  const std::array<Colour, 4> colours = {
      {{255, 255, 255}, kReferenceColour, kSensorColour, kBothColour}};
  for (int y = 0; y < panel.height(); ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * stride;
    for (int x = 0; x < panel.width(); ++x) {
      canvas.at(left + x, up + y) = colours[marks[row + static_cast<std::size_t>(x)]];
    }
  }
}

/// One column of the picture, with the clouds at one pose.
struct PictureColumn {
  std::string caption;
  RigidTransform T_level_sensor;
  Points points, above;  ///< Of the sensor in the level frame; `above` has those above the ground.
};

PictureColumn column_of(const SensorPicture& picture, const RigidTransform& T_reference_sensor,
                        const std::string& caption) {
  PictureColumn column{caption, picture.level.T_level_reference * T_reference_sensor, {}, {}};
  column.points = transformed(*picture.sensor_points, column.T_level_sensor);
  column.above = above_ground(column.points, picture.level);
  return column;
}

/// Marks the origin of a sensor if it is inside the view.
void mark_origin(Drawing& drawing, const CloudView& view, const Eigen::Vector3d& origin_m, int left,
                 int up, const std::string& colour) {
  constexpr double kRadius = 4.0;
  const Eigen::Vector3i axes = view.axes();
  const double right = origin_m(axes.x()) - view.centre_m(axes.x());
  const double above = origin_m(axes.y()) - view.centre_m(axes.y());
  if (std::abs(right) > view.half_width_m || std::abs(above) > view.half_height_m) return;
  const double x = (left + (right + view.half_width_m) / view.pixel_m) / kTextScale;
  const double y = (up + (view.half_height_m - above) / view.pixel_m) / kTextScale;
  drawing.dot(x, y, kRadius, "bar");
  drawing.dot(x, y, 0.7 * kRadius, "marker " + colour);
}

/// The number of text columns of this font size that fit a width.
std::size_t columns_in(double width, double size) {
  return static_cast<std::size_t>(width / text_width("m", size)) - 2;
}

void draw_title(Drawing& drawing, const SensorPicture& picture) {
  const double height = kTitle_px / kTextScale;
  const std::string verdict = picture.is_accepted ? "accepted"
                              : picture.after     ? "REJECTED – best guess, do not use"
                                                  : "REJECTED – no pose was found";
  // A light background for dark text, between two solid lines.
  const std::string colour = picture.is_accepted ? "c2" : "c1";
  constexpr double kLine = 5.0;
  drawing.rectangle(0.0, 0.0, drawing.width(), height, "inside " + colour);
  drawing.rectangle(0.0, 0.0, drawing.width(), kLine, "marker " + colour);
  drawing.rectangle(0.0, height - kLine, drawing.width(), kLine, "marker " + colour);
  const double left = drawing.sheet().text();
  const std::size_t columns = columns_in(drawing.width(), drawing.sheet().title());
  constexpr std::size_t kMinColumns = 8;
  const std::string name =
      cut_in_the_middle(printable(picture.sensor),
                        std::max(kMinColumns, columns - std::min(columns, verdict.size())));
  drawing.text(left, 0.47 * height, name + ": " + verdict, Anchor::start, "title");
  drawing.text(
      left, 0.82 * height,
      cut_to_columns(printable(picture.note), columns_in(drawing.width(), drawing.sheet().text())),
      Anchor::start, "name");
}

void draw_legend(Drawing& drawing, const SensorPicture& picture, double pixel_m) {
  const double text = drawing.sheet().text();
  const std::size_t columns = columns_in(drawing.width(), text);
  const double line = drawing.height() - 0.35 * kLegend_px / kTextScale;
  double x = text;
  const auto add = [&](const std::string& style, const std::string& name) {
    const std::string label = cut_in_the_middle(printable(name), columns / 4);
    drawing.rectangle(x, line - 0.8 * text, 0.8 * text, 0.8 * text, style);
    drawing.text(x + 1.2 * text, line, label, Anchor::start, "name");
    x += 2.4 * text + text_width(label, text);
  };
  add("marker c0", picture.reference);
  add("marker c4", picture.sensor);
  add("bar", "both");
  const double bar_m = scale_bar_m(kPanelWidth_px * pixel_m);
  const double bar = bar_m / pixel_m / kTextScale;
  const double right = drawing.width() - text;
  drawing.rectangle(right - bar, line - 0.4 * text, bar, 3.0, "bar");
  drawing.text(right - bar - 0.5 * text, line, shortest_number(bar_m) + " m", Anchor::end, "name");
}

}  // namespace

Image draw_sensor(const SensorPicture& picture) {
  std::vector<PictureColumn> columns;
  if (picture.before) columns.push_back(column_of(picture, *picture.before, "before (nominal)"));
  if (picture.after) {
    columns.push_back(
        column_of(picture, *picture.after, picture.is_accepted ? "after" : "best guess, REJECTED"));
  }
  const Points& reference = *picture.reference_points;
  const Points reference_above = above_ground(reference, picture.level);
  const std::array<PictureRow, 3> rows =
      rows_of(shown_points(reference_above, columns.back().above,
                           picture.level.T_level_reference.translation.cast<float>(),
                           columns.back().T_level_sensor.translation.cast<float>()),
              picture.level.has_ground);
  const int count = static_cast<int>(columns.size());
  int height = kTitle_px + kLegend_px;
  for (const PictureRow& row : rows) height += kCaption_px + row.view.image().height();
  Image canvas(count * (kPanelWidth_px + kGap_px) + kGap_px, height);
  Drawing drawing(canvas.width() / kTextScale, canvas.height() / kTextScale);
  draw_title(drawing, picture);
  int up = kTitle_px;
  for (const PictureRow& row : rows) {
    int left = kGap_px;
    const int panel_height = row.view.image().height();
    for (const PictureColumn& column : columns) {
      draw_panel(canvas, left, up + kCaption_px, row.shows_ground ? reference : reference_above,
                 row.shows_ground ? column.points : column.above, row.view);
      drawing.text((left + kPanelWidth_px / 2.0) / kTextScale,
                   (up + 0.75 * kCaption_px) / kTextScale, column.caption + ", " + row.caption,
                   Anchor::middle, "name");
      drawing.rectangle(left / kTextScale, (up + kCaption_px) / kTextScale,
                        kPanelWidth_px / kTextScale, panel_height / kTextScale, "zero");
      const auto mark = [&](const RigidTransform& T, const std::string& colour) {
        mark_origin(drawing, row.view, T.translation, left, up + kCaption_px, colour);
      };
      mark(picture.level.T_level_reference, "c0");
      mark(column.T_level_sensor, "c4");
      left += kPanelWidth_px + kGap_px;
    }
    up += kCaption_px + panel_height;
  }
  draw_legend(drawing, picture, rows.front().view.pixel_m);
  draw_on(canvas, drawing, kTextScale);
  return canvas;
}

}  // namespace croon
