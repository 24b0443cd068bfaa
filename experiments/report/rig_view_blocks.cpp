#include "experiments/report/rig_view_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "framework/base/base64.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/cloud_view.hpp"
#include "framework/picture/colour.hpp"

namespace croon::experiments {
namespace {

using nlohmann::ordered_json;

constexpr double kDistanceUnit_m = 0.002;

ordered_json matrix_json(const std::optional<RigidTransform>& T) {
  if (!T) return nullptr;
  ordered_json rows = ordered_json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows.push_back(T->rotation(row, column));
    rows.push_back(T->translation(row));
  }
  for (const double last : {0.0, 0.0, 0.0, 1.0}) rows.push_back(last);
  return rows;
}

/// Points as 16-bit integers: `point = value * scale_m + origin_m`.
struct QuantisedPoints {
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  double scale_m = 0.001;
  std::string bytes;  ///< x, y, z of each point, little-endian.
};

QuantisedPoints quantised(const Points& points) {
  constexpr double kMax = 32767.0;
  QuantisedPoints result;
  if (points.empty()) return result;
  Eigen::Vector3f low = points.front(), high = low;
  for (const Eigen::Vector3f& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  result.origin_m = 0.5 * (low + high).cast<double>();
  result.scale_m = std::max(1e-3, 0.5 * static_cast<double>((high - low).maxCoeff()) / kMax);
  result.bytes.reserve(6 * points.size());
  for (const Eigen::Vector3f& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const double steps =
          (static_cast<double>(point(axis)) - result.origin_m(axis)) / result.scale_m;
      const auto value = static_cast<std::uint16_t>(
          static_cast<std::int16_t>(std::lround(std::clamp(steps, -kMax, kMax))));
      result.bytes += static_cast<char>(value & 0xFFU);
      result.bytes += static_cast<char>(value >> 8U);
    }
  }
  return result;
}

/// A byte per point: the distance in units of `kDistanceUnit_m`, 255 without a surface.
std::string distance_bytes(const Distances& distances) {
  constexpr double kFarthest = 254.0;
  std::string bytes;
  for (const float distance_m : distances) {
    const double units = std::round(static_cast<double>(distance_m) / kDistanceUnit_m);
    bytes += static_cast<char>(
        static_cast<std::uint8_t>(std::isnan(units) ? 255.0 : std::min(units, kFarthest)));
  }
  return bytes;
}

ordered_json sensor_json(const ViewedSensor& sensor, std::size_t index) {
  const QuantisedPoints points = quantised(sensor.points);
  ordered_json poses = ordered_json::array();
  for (const std::optional<RigidTransform>& pose : sensor.poses) poses.push_back(matrix_json(pose));
  ordered_json distances = ordered_json::object();
  for (const auto& [state, of_state] : sensor.distances) {
    distances[std::to_string(state)] = base64(distance_bytes(of_state));
  }
  ordered_json json = {
      {"name", valid_utf8(sensor.sensor)},
      {"colour", hex_text(sensor_colour(index))},
      {"role", sensor.is_reference  ? "reference"
               : sensor.is_accepted ? "accepted"
                                    : "rejected"},
      {"count", sensor.points.size()},
      {"scale_m", points.scale_m},
      {"origin_m", {points.origin_m.x(), points.origin_m.y(), points.origin_m.z()}},
      {"points", base64(points.bytes)},
      {"poses", std::move(poses)},
      {"distances", std::move(distances)}};
  if (sensor.rival) json["rival"] = matrix_json(sensor.rival);
  return json;
}

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

std::string rig_view_json(const RigView& view) {
  ordered_json json = {{"states", view.states},
                       {"frame_note", view.level.has_ground ? "level frame of the reference"
                                                            : "frame of the reference"},
                       {"distance_unit_m", kDistanceUnit_m}};
  ordered_json sensors = ordered_json::array();
  for (std::size_t i = 0; i < view.sensors.size(); ++i) {
    sensors.push_back(sensor_json(view.sensors[i], i));
  }
  json["sensors"] = std::move(sensors);
  json["closeups"] = ordered_json::array();
  for (const CloseUp& place : view.close_ups) {
    json["closeups"].push_back(
        {{"title", place.title},
         {"centre_m", {place.centre_m.x(), place.centre_m.y(), place.centre_m.z()}},
         {"half_width_m", place.half_width_m}});
  }
  return json.dump();
}

CloudViewBlock cloud_view_block(const RigView& view, const std::string& caption) {
  CloudView shown = {25.0, 25.0, 0.1};
  shown.dot_px = 2;
  return {caption,
          rig_view_json(view),
          {{"", "The clouds from above, before and after", before_and_after(view, shown)}}};
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
