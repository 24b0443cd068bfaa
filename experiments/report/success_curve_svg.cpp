#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "experiments/report/plots.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"
#include "framework/picture/svg.hpp"

namespace croon::experiments {
namespace {

constexpr double kWidth = 380.0;  // Of a panel; pixels, all of them.
constexpr double kHeight = 280.0;
constexpr double kLeft = 56.0;
constexpr double kGap = 44.0;
constexpr double kTop = 60.0;
constexpr double kBelow = 50.0;
constexpr double kLegendLine = 20.0;
constexpr double kLegendWidth = 220.0;

/// A panel: rotation or translation.
struct Panel {
  CurveOf of;
  const char* title;
  double SuccessBounds::*threshold;
};

constexpr std::array kPanels = {
    Panel{CurveOf::rotation, "rotation error at most, deg", &SuccessBounds::rotation_deg},
    Panel{CurveOf::translation, "translation error at most, m", &SuccessBounds::translation_m}};

/// The rows with a line, of one panel, each with its name.
std::vector<std::pair<std::string, const CurveRow*>> lines_of(const SuccessCurve& curve,
                                                              CurveOf of) {
  std::set<std::string> variants;
  for (const CurveRow& row : curve.rows) variants.insert(row.variant);
  std::vector<std::pair<std::string, const CurveRow*>> lines;
  for (const CurveRow& row : curve.rows) {
    const bool is_shown = variants.size() == 1 || row.sensor.empty();
    if (row.of != of || !is_shown) continue;
    const std::string sensor = row.sensor.empty() ? "all sensors" : row.sensor;
    lines.emplace_back(variants.size() == 1 ? sensor : row.variant, &row);
  }
  return lines;
}

std::string colour_of(std::size_t line) { return "c" + std::to_string(line % kChartColours); }

void draw_axes(Svg& svg, const Plot& plot, const Panel& panel, double bound) {
  for (const double ratio : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    plot.draw_y_tick(svg, ratio, fixed_number(100.0 * ratio, 0), 8.0,
                     ratio == 0.0 ? "zero" : "grid");
  }
  for (double exponent = std::ceil(plot.x_range.low); exponent <= plot.x_range.high; ++exponent) {
    plot.draw_x_tick(svg, exponent, shortest_number(std::pow(10.0, exponent)), 18.0);
  }
  const double x = plot.x(std::log10(bound));
  svg.line(x, plot.top, x, plot.top + plot.height, "zero");
  svg.text(x - 4.0, plot.top + 12.0, "bound", Anchor::end, "small");
  svg.text(plot.left + plot.width / 2.0, plot.top + plot.height + 38.0, panel.title, Anchor::middle,
           "small");
}

void draw_line(Svg& svg, const Plot& plot, const std::vector<double>& thresholds,
               const CurveRow& row, const std::string& colour) {
  for (std::size_t i = 1; i < row.shares.size(); ++i) {
    svg.line(plot.x(std::log10(thresholds[i - 1])), plot.y(row.shares[i - 1].ratio),
             plot.x(std::log10(thresholds[i])), plot.y(row.shares[i].ratio), colour + " curve");
  }
}

}  // namespace

std::string success_curve_svg(const SuccessCurve& curve) {
  const auto legend = lines_of(curve, CurveOf::rotation);
  const double legend_left = kLeft + 2.0 * kWidth + kGap + 24.0;
  const double width = legend_left + kLegendWidth;
  const double height =
      kTop + std::max(kHeight, kLegendLine * static_cast<double>(legend.size())) + kBelow;
  Svg svg(width, height, kChartStyle);
  svg.rectangle(0.0, 0.0, width, height, "page");
  svg.text(kLeft, 24.0, "Trials within a threshold of the truth, in % of all trials", Anchor::start,
           "title");
  double left = kLeft;
  for (const Panel& panel : kPanels) {
    std::vector<double> thresholds;
    for (const SuccessBounds& bounds : curve.thresholds) {
      thresholds.push_back(bounds.*panel.threshold);
    }
    const Plot plot = {left,
                       kTop,
                       kWidth,
                       kHeight,
                       {std::log10(thresholds.front()), std::log10(thresholds.back())},
                       {0.0, 1.0}};
    draw_axes(svg, plot, panel, thresholds[thresholds.size() / 2]);
    const auto lines = lines_of(curve, panel.of);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      draw_line(svg, plot, thresholds, *lines[i].second, colour_of(i));
    }
    left += kWidth + kGap;
  }
  for (std::size_t i = 0; i < legend.size(); ++i) {
    constexpr std::size_t kColumns = 26;
    const double y = kTop + 8.0 + kLegendLine * static_cast<double>(i);
    svg.line(legend_left, y, legend_left + 24.0, y, colour_of(i) + " curve");
    svg.text(legend_left + 32.0, y + 4.0, cut_in_the_middle(legend[i].first, kColumns),
             Anchor::start, "name");
  }
  return svg.bytes();
}

}  // namespace croon::experiments
