#include "experiments/report/rig_charts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/report/panels.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/fit_check.hpp"

namespace croon::experiments {
namespace {

/// What a panel shows the residuals over.
struct ResidualAxis {
  const char* title;
  double Residual::*value;
};

constexpr std::array kResidualAxes = {ResidualAxis{"azimuth, deg", &Residual::azimuth_deg},
                                      ResidualAxis{"elevation, deg", &Residual::elevation_deg},
                                      ResidualAxis{"range, m", &Residual::range_m},
                                      ResidualAxis{"incidence, deg", &Residual::incidence_deg}};

/// The residuals in the bins of an axis, in mm.
struct ResidualProfile {
  std::vector<double> centres;
  std::vector<double> medians;  ///< NaN in a bin with few residuals.
  std::vector<std::optional<Interval>> quartiles;
};

/// The axis of a panel: between the percentiles 1 and 99 of the values.
Axis axis_of(const std::vector<Residual>& residuals, double Residual::*value) {
  std::vector<double> values;
  for (const Residual& residual : residuals) values.push_back(residual.*value);
  return round_axis(percentile(values, 0.01), percentile(values, 0.99), 5);
}

ResidualProfile residual_profile(const std::vector<Residual>& residuals, double Residual::*value,
                                 const Axis& axis) {
  constexpr std::size_t kBins = 30, kMinPerBin = 25;
  std::array<std::vector<double>, kBins> bins;
  const double width = (axis.high - axis.low) / static_cast<double>(kBins);
  for (const Residual& residual : residuals) {
    const double position = (residual.*value - axis.low) / width;
    if (position < 0.0 || position >= static_cast<double>(kBins)) continue;
    bins.at(static_cast<std::size_t>(position)).push_back(1e3 * residual.distance_m);
  }
  ResidualProfile profile;
  for (std::size_t i = 0; i < kBins; ++i) {
    profile.centres.push_back(axis.low + (static_cast<double>(i) + 0.5) * width);
    const bool is_full = bins.at(i).size() >= kMinPerBin;
    profile.medians.push_back(is_full ? median(bins.at(i)) : std::nan(""));
    profile.quartiles.push_back(is_full ? std::optional(Interval{percentile(bins.at(i), 0.25),
                                                                 percentile(bins.at(i), 0.75)})
                                        : std::nullopt);
  }
  return profile;
}

/// Half the height of the panels, in mm. A few bins may reach beyond it.
double residual_limit_mm(const std::vector<ResidualProfile>& profiles) {
  constexpr double kMin_mm = 20.0, kShown = 0.92;
  std::vector<double> ends_mm = {kMin_mm};
  for (const ResidualProfile& profile : profiles) {
    for (const std::optional<Interval>& quartiles : profile.quartiles) {
      if (!quartiles) continue;
      ends_mm.push_back(std::max(std::abs(quartiles->low), std::abs(quartiles->high)));
    }
  }
  return std::max(kMin_mm, percentile(ends_mm, kShown));
}

/// The quartiles, cut at the ends of the axis.
std::vector<std::optional<Interval>> cut_quartiles(const ResidualProfile& profile,
                                                   const Axis& axis) {
  std::vector<std::optional<Interval>> cut = profile.quartiles;
  for (std::optional<Interval>& quartiles : cut) {
    if (!quartiles) continue;
    quartiles->low = std::clamp(quartiles->low, axis.low, axis.high);
    quartiles->high = std::clamp(quartiles->high, axis.low, axis.high);
  }
  return cut;
}

constexpr double kNodeWidth = 120.0, kNodeHeight = 40.0;

/// The centre of the node of `sensor`, one of `view.sensors`, on an ellipse, so that no edge passes
/// through a third node. The reference is at the top.
Corner node_centre(const RigView& view, const ViewedSensor& sensor, double width, double height) {
  const auto index = static_cast<double>(&sensor - view.sensors.data());
  const double angle = 2.0 * kPi * index / static_cast<double>(view.sensors.size());
  return {width / 2.0 + 0.41 * width * std::sin(angle),
          height / 2.0 - 0.43 * height * std::cos(angle)};
}

void draw_node(Drawing& drawing, const Corner& centre, const ViewedSensor& sensor) {
  const bool is_good = sensor.is_accepted && !is_contradicted(sensor.refit);
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

/// The sensor of the view with this name, which must exist.
const ViewedSensor& viewed_sensor(const RigView& view, const std::string& sensor) {
  return *std::find_if(view.sensors.begin(), view.sensors.end(),
                       [&](const ViewedSensor& one) { return one.sensor == sensor; });
}

}  // namespace

Drawing residual_chart(const ViewedSensor& sensor, const Sheet& sheet) {
  std::vector<Axis> axes;
  std::vector<ResidualProfile> profiles;
  for (const ResidualAxis& axis : kResidualAxes) {
    axes.push_back(axis_of(sensor.residuals, axis.value));
    profiles.push_back(residual_profile(sensor.residuals, axis.value, axes.back()));
  }
  const double limit_mm = residual_limit_mm(profiles);
  const Axis y = round_axis(-limit_mm, limit_mm, 4);
  Sheet untitled = sheet;  // The report has a caption.
  untitled.has_title = false;
  auto [grid, drawing] = panel_figure(
      untitled, "Residuals of " + sensor.sensor + " over azimuth, elevation, range and incidence",
      "Medians, in a band between the quartiles", kResidualAxes.size(), is_wide(sheet) ? 4 : 2, 0.8,
      {});
  const double text = sheet.small();
  for (std::size_t k = 0; k < kResidualAxes.size(); ++k) {
    const Plot plot = plot_of(grid, k, {axes[k].low, axes[k].high}, {y.low, y.high});
    for (const double tick : y.ticks) {
      plot.draw_y_tick(drawing, tick, fixed_number(tick, y.decimals), 0.5 * text,
                       tick == 0.0 ? "zero" : "grid");
    }
    for (const double tick : axes[k].ticks) {
      plot.draw_x_tick(drawing, tick, fixed_number(tick, axes[k].decimals), 1.4 * text);
    }
    draw_band(drawing, plot, profiles[k].centres, cut_quartiles(profiles[k], y), 0);
    draw_parts(drawing, plot, profiles[k].centres, profiles[k].medians, 0);
    draw_panel_texts(drawing, plot, "distance, mm", kResidualAxes.at(k).title);
  }
  return drawing;
}

Drawing sensor_graph(const RigView& view, const Sheet& sheet) {
  const double width = sheet.width > 0.0 ? sheet.width : 760.0;
  const double height = 0.5 * width;
  Drawing drawing(width, height, sheet);
  drawing.describe("The graph of sensors: overlap and median distance of each pair");
  drawing.rectangle(0.0, 0.0, width, height, "page");
  const auto centre_of = [&](const ViewedSensor& sensor) {
    return node_centre(view, sensor, width, height);
  };
  for (const bool is_text : {false, true}) {
    for (const SensorAgreement& pair : view.pairs) {
      const ViewedSensor &a = viewed_sensor(view, pair.a), &b = viewed_sensor(view, pair.b);
      const bool is_accepted = a.is_accepted && b.is_accepted;
      const Corner from = centre_of(a), to = centre_of(b);
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
  for (const ViewedSensor& sensor : view.sensors) draw_node(drawing, centre_of(sensor), sensor);
  return drawing;
}

}  // namespace croon::experiments
