#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "experiments/report/bands.hpp"
#include "experiments/report/figure_title.hpp"
#include "experiments/report/plots.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {
namespace {

/// A panel: rotation or translation.
struct Panel {
  CurveOf of;
  const char* title;
  double SuccessBounds::*threshold;
};

constexpr std::array kPanels = {
    Panel{CurveOf::rotation, "rotation error at most, deg", &SuccessBounds::rotation_deg},
    Panel{CurveOf::translation, "translation error at most, m", &SuccessBounds::translation_m}};

/// Where things are, in units of the sheet.
struct CurveLayout {
  std::size_t columns;  ///< Panels beside each other.
  double left, top, plot_width, plot_height, panel_width, panel_height, width, height;
  std::size_t legend_columns;  ///< Entries beside each other, below the panels.
  double legend_width, legend_line, legend_top;
};

/// The rows with a line, of one panel, each with its name: of one variant alone the sensors.
std::vector<std::pair<std::string, const CurveRow*>> lines_of(const SuccessCurve& curve,
                                                              CurveOf of) {
  std::set<std::string> variants;
  for (const CurveRow& row : curve.rows) variants.insert(row.variant);
  const bool is_alone = variants.size() == 1;
  std::vector<std::pair<std::string, const CurveRow*>> lines;
  for (const CurveRow& row : curve.rows) {
    if (row.of != of || !(is_alone || row.sensor.empty())) continue;
    const std::string sensor = row.sensor.empty() ? "all sensors" : row.sensor;
    lines.emplace_back(is_alone ? sensor : row.variant, &row);
  }
  return lines;
}

double width_of(const Sheet& sheet) { return sheet.width > 0.0 ? sheet.width : 900.0; }

/// The lines with a band: of sensors, whose bands overlap, that of all sensors alone.
std::vector<std::size_t> band_lines(const SuccessCurve& curve) {
  const auto lines = lines_of(curve, CurveOf::rotation);
  if (lines.empty()) return {};
  if (lines.front().second->sensor.empty()) return lines_with_band(lines.size());
  return {lines.size() - 1};
}

CurveLayout layout_of(const Sheet& sheet, const std::vector<std::string>& labels,
                      double title_height) {
  const double text = sheet.small();
  CurveLayout layout{};
  layout.columns = sheet.width <= 0.0 || sheet.width > 1.5 * kOneColumn.width ? 2 : 1;
  layout.width = width_of(sheet);
  layout.left = 4.0 * text;
  layout.top = title_height + 1.6 * text;
  layout.panel_width = layout.width / static_cast<double>(layout.columns);
  layout.plot_width = layout.panel_width - layout.left - 1.5 * text;
  layout.plot_height = 0.62 * layout.plot_width;
  layout.panel_height = layout.plot_height + 5.2 * text;
  double widest = 0.0;
  for (const std::string& label : labels) widest = std::max(widest, text_width(label, text));
  layout.legend_width = legend_line(sheet) + widest + 2.0 * text;
  layout.legend_line = 1.6 * text;
  const auto entries = static_cast<double>(std::max<std::size_t>(labels.size(), 1));
  const double fitting = std::floor((layout.width - layout.left) / layout.legend_width);
  layout.legend_columns = static_cast<std::size_t>(std::clamp(fitting, 1.0, entries));
  const double panel_rows = place_in_grid(kPanels.size(), layout.columns).row;
  layout.legend_top = layout.top + panel_rows * layout.panel_height + 0.6 * text;
  layout.height =
      layout.legend_top +
      layout.legend_line * std::ceil(entries / static_cast<double>(layout.legend_columns));
  return layout;
}

/// Draws the frame of a panel and returns its plot: to the right the decimal logarithm of the
/// threshold, upwards the share. The threshold in the middle is the success bound.
Plot draw_panel(Drawing& drawing, const CurveLayout& layout, std::size_t index,
                const std::string& title, const std::vector<double>& thresholds) {
  const double text = drawing.sheet().small();
  const auto [row, column] = place_in_grid(index, layout.columns);
  const Plot plot = {layout.left + column * layout.panel_width,
                     layout.top + row * layout.panel_height,
                     layout.plot_width,
                     layout.plot_height,
                     {std::log10(thresholds.front()), std::log10(thresholds.back())},
                     {0.0, 1.0}};
  for (const double ratio : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    plot.draw_y_tick(drawing, ratio, fixed_number(100.0 * ratio, 0), 0.7 * text,
                     ratio == 0.0 ? "zero" : "grid");
  }
  for (double exponent = std::ceil(plot.x_range.low); exponent <= plot.x_range.high; ++exponent) {
    plot.draw_x_tick(drawing, exponent, shortest_number(std::pow(10.0, exponent)), 1.4 * text);
  }
  const double bound_x = plot.x(std::log10(thresholds[thresholds.size() / 2]));
  drawing.line(bound_x, plot.top, bound_x, plot.top + plot.height, "zero");
  drawing.text(bound_x, plot.top - 0.4 * text, "bound", Anchor::middle, "small");
  drawing.text(plot.left + plot.width / 2.0, plot.top + plot.height + 2.9 * text, title,
               Anchor::middle, "small");
  if (!drawing.sheet().has_title && index % layout.columns == 0) {
    drawing.text(plot.left - 2.9 * text, plot.top + plot.height / 2.0, "share of all trials, %",
                 Anchor::middle, "small", -90.0);
  }
  return plot;
}

/// Draws the line of a row. Markers of several stand at other thresholds.
void draw_curve(Drawing& drawing, const Plot& plot, const std::vector<double>& thresholds,
                const CurveRow& row, std::size_t series) {
  constexpr std::size_t kMarkerEvery = 4;
  std::vector<Corner> curve;
  for (std::size_t i = 0; i < row.shares.size(); ++i) {
    curve.push_back({plot.x(std::log10(thresholds[i])), plot.y(row.shares[i].ratio)});
  }
  drawing.polyline(curve, "curve " + series_style(series));
  for (std::size_t i = series % kMarkerEvery; i < curve.size(); i += kMarkerEvery) {
    draw_marker(drawing, curve[i][0], curve[i][1], 0.25 * drawing.sheet().small(), series);
  }
}

void draw_legend(Drawing& drawing, const CurveLayout& layout,
                 const std::vector<std::string>& labels) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto [row, column] = place_in_grid(i, layout.legend_columns);
    draw_legend_entry(drawing, layout.left + layout.legend_width * column,
                      layout.legend_top + layout.legend_line * row, i, labels[i]);
  }
}

}  // namespace

Drawing success_curve_chart(const SuccessCurve& curve, const FigureOptions& options) {
  constexpr const char* kTitle = "Trials within a threshold of the truth, in % of all trials";
  constexpr std::size_t kLabelColumns = 30;
  std::vector<std::string> names;
  for (const auto& line : lines_of(curve, CurveOf::rotation)) names.push_back(line.first);
  const std::vector<std::string> labels = distinct_labels(names, kLabelColumns);
  const std::vector<std::size_t> with_band = band_lines(curve);
  const std::string explanation =
      "The vertical line is the bound of success; " + band_sentence(labels, with_band);
  const FigureTitle title(kTitle, explanation, options.sheet, width_of(options.sheet));
  const CurveLayout layout = layout_of(options.sheet, labels, title.height());
  Drawing drawing(layout.width, layout.height, options.sheet);
  drawing.describe(std::string(kTitle) + ". " + explanation + ".");
  drawing.rectangle(0.0, 0.0, layout.width, layout.height, "page");
  title.draw(drawing, 0.5 * options.sheet.small(), 0.3 * options.sheet.small());
  for (std::size_t p = 0; p < kPanels.size(); ++p) {
    std::vector<double> thresholds;
    const bool is_in_mm = kPanels[p].of == CurveOf::translation && options.length_unit == "mm";
    for (const SuccessBounds& bounds : curve.thresholds) {
      thresholds.push_back((is_in_mm ? 1000.0 : 1.0) * bounds.*kPanels[p].threshold);
    }
    const std::string axis = kPanels[p].title + std::string(is_in_mm ? "m" : "");
    const Plot plot = draw_panel(drawing, layout, p, axis, thresholds);
    const auto lines = lines_of(curve, kPanels[p].of);
    std::vector<double> exponents;
    for (const double threshold : thresholds) exponents.push_back(std::log10(threshold));
    for (const std::size_t i : with_band) {
      draw_band(drawing, plot, exponents, intervals_of(lines[i].second->shares), i);
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      draw_curve(drawing, plot, thresholds, *lines[i].second, i);
    }
  }
  draw_legend(drawing, layout, labels);
  return drawing;
}

}  // namespace croon::experiments
