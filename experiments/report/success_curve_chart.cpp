#include <array>
#include <cmath>

#include "experiments/report/panels.hpp"

namespace croon::experiments {
namespace {

/// A panel: rotation or translation.
struct CurvePanel {
  CurveOf of;
  const char* title;
  double SuccessBounds::*threshold;
};

constexpr std::array kCurvePanels = {
    CurvePanel{CurveOf::rotation, "maximum rotation error, deg", &SuccessBounds::rotation_deg},
    CurvePanel{CurveOf::translation, "maximum translation error, m",
               &SuccessBounds::translation_m}};

/// The rows of one panel that are drawn as lines, each with its name.
std::vector<std::pair<std::string, const CurveRow*>> curve_lines(const SuccessCurve& curve,
                                                                 CurveOf of) {
  const bool is_one_variant = has_one_variant(curve.rows);
  std::vector<std::pair<std::string, const CurveRow*>> lines;
  for (const CurveRow& row : curve.rows) {
    const std::string name = row.of == of ? line_name(row, is_one_variant) : "";
    if (!name.empty()) lines.emplace_back(name, &row);
  }
  return lines;
}

/// The lines with a band: bands of sensors overlap, so only the line of all sensors has one.
std::vector<std::size_t> band_lines(const SuccessCurve& curve) {
  const auto lines = curve_lines(curve, CurveOf::rotation);
  if (lines.empty()) return {};
  if (lines.front().second->sensor.empty()) return lines_with_band(lines.size());
  return {lines.size() - 1};
}

/// Draws the frame of a panel: the decimal logarithm of the threshold on the x axis, the share on
/// the y axis. The middle threshold is the success bound.
void draw_curve_panel(Drawing& drawing, const Plot& plot, const std::string& title,
                      const std::vector<double>& exponents) {
  const double text = drawing.sheet().small();
  draw_percent_ticks(drawing, plot);
  draw_decade_ticks(drawing, plot);
  const double bound_x = plot.x(exponents[exponents.size() / 2]);
  drawing.line(bound_x, plot.top, bound_x, plot.top + plot.height, "zero");
  drawing.text(bound_x, plot.top - 0.4 * text, "bound", Anchor::middle, "small");
  draw_panel_texts(drawing, plot, "", title);
}

}  // namespace

Drawing success_curve_chart(const SuccessCurve& curve, const FigureOptions& options) {
  constexpr const char* kTitle = "Trials within a threshold of ground truth, in % of all trials";
  constexpr double kAspect = 0.62;
  constexpr std::size_t kMarkerEvery = 4;
  std::vector<std::string> names;
  for (const auto& line : curve_lines(curve, CurveOf::rotation)) names.push_back(line.first);
  const std::vector<std::string> labels = line_labels(names);
  const std::vector<std::size_t> with_band = band_lines(curve);
  const std::string explanation =
      "The vertical line is the success bound; " + band_sentence(labels, with_band);
  auto [grid, drawing] = panel_figure(options.sheet, kTitle, explanation, kCurvePanels.size(),
                                      is_wide(options.sheet) ? 2 : 1, kAspect, labels);
  for (std::size_t p = 0; p < kCurvePanels.size(); ++p) {
    const bool is_in_mm = kCurvePanels[p].of == CurveOf::translation && options.length_unit == "mm";
    std::vector<double> exponents;
    for (const SuccessBounds& bounds : curve.thresholds) {
      exponents.push_back(
          std::log10((is_in_mm ? 1000.0 : 1.0) * bounds.*kCurvePanels[p].threshold));
    }
    const Plot plot = plot_of(grid, p, {exponents.front(), exponents.back()}, {0.0, 1.0});
    draw_curve_panel(drawing, plot, kCurvePanels[p].title + std::string(is_in_mm ? "m" : ""),
                     exponents);
    draw_side_text(drawing, grid, p, plot, "share of all trials, %");
    const auto lines = curve_lines(curve, kCurvePanels[p].of);
    for (const std::size_t i : with_band) {
      draw_band(drawing, plot, exponents, intervals_of(lines[i].second->shares), i);
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::vector<double> ratios;
      for (const Share& share : lines[i].second->shares) ratios.push_back(share.ratio);
      draw_series(drawing, plot, exponents, ratios, i, kMarkerEvery);
    }
  }
  draw_panel_legend(drawing, grid, labels);
  return drawing;
}

}  // namespace croon::experiments
