#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/report/bands.hpp"
#include "experiments/report/figure_title.hpp"
#include "experiments/report/plots.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {
namespace {

constexpr std::size_t kPanels = 6;

/// A line: its label, and its rows by Dof.
struct CoverageLine {
  std::string name;
  std::array<const CoverageRow*, kPanels> rows = {};
};

/// The lines, of one variant alone its sensors, and the one of all sensors at the end.
std::vector<CoverageLine> coverage_lines(const Coverage& coverage) {
  std::set<std::string> variants;
  for (const CoverageRow& row : coverage.rows) variants.insert(row.variant);
  const bool is_alone = variants.size() == 1;
  std::vector<CoverageLine> lines;
  for (const CoverageRow& row : coverage.rows) {
    if (!row.dof || !(is_alone || row.sensor.empty())) continue;
    if (*row.dof == Dof::roll) {
      const std::string sensor = row.sensor.empty() ? "all sensors" : row.sensor;
      lines.push_back({is_alone ? sensor : row.variant, {}});
    }
    lines.back().rows.at(static_cast<std::size_t>(*row.dof)) = &row;
  }
  return lines;
}

/// Where things are, in units of the sheet.
struct CoverageLayout {
  std::size_t columns;
  double left, top, side, panel_width, panel_height, width, height;
  std::size_t legend_columns;
  double legend_width, legend_line, legend_top;
};

double width_of_coverage(const Sheet& sheet) { return sheet.width > 0.0 ? sheet.width : 900.0; }

CoverageLayout coverage_layout(const Sheet& sheet, const std::vector<std::string>& labels,
                               double title_height) {
  const double text = sheet.small();
  CoverageLayout layout{};
  layout.width = width_of_coverage(sheet);
  layout.columns = sheet.width <= 0.0 || sheet.width > 1.5 * kOneColumn.width ? 3 : 2;
  layout.left = 3.6 * text;
  layout.top = title_height + 1.8 * text;
  layout.panel_width = layout.width / static_cast<double>(layout.columns);
  layout.side = layout.panel_width - layout.left - 1.2 * text;
  layout.panel_height = layout.side + 5.2 * text;
  double widest = 0.0;
  for (const std::string& label : labels) widest = std::max(widest, text_width(label, text));
  layout.legend_width = legend_line(sheet) + widest + 2.0 * text;
  layout.legend_line = 1.6 * text;
  const auto entries = static_cast<double>(std::max<std::size_t>(labels.size(), 1));
  const double fitting = std::floor((layout.width - layout.left) / layout.legend_width);
  layout.legend_columns = static_cast<std::size_t>(std::clamp(fitting, 1.0, entries));
  const double panel_rows = place_in_grid(kPanels, layout.columns).row;
  layout.legend_top = layout.top + panel_rows * layout.panel_height + 0.6 * text;
  layout.height =
      layout.legend_top +
      layout.legend_line * std::ceil(entries / static_cast<double>(layout.legend_columns));
  return layout;
}

/// Draws the frame of the panel of a degree of freedom and returns its plot: to the right the level
/// of the interval, upwards the share of trials whose truth it holds.
Plot coverage_panel(Drawing& drawing, const CoverageLayout& layout, std::size_t dof) {
  const double text = drawing.sheet().small();
  const auto [row, column] = place_in_grid(dof, layout.columns);
  const Plot plot = {layout.left + column * layout.panel_width,
                     layout.top + row * layout.panel_height,
                     layout.side,
                     layout.side,
                     {0.0, 1.0},
                     {0.0, 1.0}};
  for (const double ratio : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const std::string percent = fixed_number(100.0 * ratio, 0);
    plot.draw_y_tick(drawing, ratio, percent, 0.7 * text, ratio == 0.0 ? "zero" : "grid");
    plot.draw_x_tick(drawing, ratio, percent, 1.4 * text);
  }
  drawing.line(plot.x(0.0), plot.y(0.0), plot.x(1.0), plot.y(1.0), "zero");
  const double middle = plot.left + plot.width / 2.0;
  drawing.text(middle, plot.top - 0.5 * text, kDofNames.at(dof), Anchor::middle, "small");
  drawing.text(middle, plot.top + plot.height + 2.8 * text, "level of the interval, %",
               Anchor::middle, "small");
  return plot;
}

void draw_coverage(Drawing& drawing, const Plot& plot, const CoverageRow& row, std::size_t series) {
  std::vector<Corner> curve;
  for (std::size_t k = 0; k < row.held.size(); ++k) {
    curve.push_back({plot.x(kCoverageLevels.at(k)), plot.y(row.held[k].ratio)});
  }
  drawing.polyline(curve, "curve " + series_style(series));
  for (const auto& [x, y] : curve) {
    draw_marker(drawing, x, y, 0.2 * drawing.sheet().small(), series);
  }
}

}  // namespace

Drawing coverage_chart(const Coverage& coverage, const FigureOptions& options) {
  constexpr const char* kTitle = "How often intervals hold the truth, in % of accepted trials";
  constexpr std::size_t kNameColumns = 30;
  const std::vector<CoverageLine> lines = coverage_lines(coverage);
  std::vector<std::string> names;
  for (const CoverageLine& line : lines) names.push_back(line.name);
  const std::vector<std::string> labels = distinct_labels(names, kNameColumns);
  // Bands of sensors overlap: of several lines that of all sensors alone has one.
  const std::vector<std::size_t> with_band = {lines.size() - 1};
  const std::string explanation =
      "On the diagonal intervals are right, above it too wide; " + band_sentence(labels, with_band);
  const Sheet& sheet = options.sheet;
  const FigureTitle title(kTitle, explanation, sheet, width_of_coverage(sheet));
  const CoverageLayout layout = coverage_layout(sheet, labels, title.height());
  Drawing drawing(layout.width, layout.height, sheet);
  drawing.describe(std::string(kTitle) + ". " + explanation + ".");
  drawing.rectangle(0.0, 0.0, layout.width, layout.height, "page");
  title.draw(drawing, 0.5 * sheet.small(), 0.3 * sheet.small());
  const std::vector<double> levels(kCoverageLevels.begin(), kCoverageLevels.end());
  for (std::size_t dof = 0; dof < kPanels; ++dof) {
    const Plot plot = coverage_panel(drawing, layout, dof);
    for (const std::size_t i : with_band) {
      draw_band(drawing, plot, levels, intervals_of(lines[i].rows.at(dof)->held), i);
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      draw_coverage(drawing, plot, *lines[i].rows.at(dof), i);
    }
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto [row, column] = place_in_grid(i, layout.legend_columns);
    draw_legend_entry(drawing, layout.left + layout.legend_width * column,
                      layout.legend_top + layout.legend_line * row, i, labels[i]);
  }
  return drawing;
}

}  // namespace croon::experiments
