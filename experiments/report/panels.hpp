#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/report/plots.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {

// What figures with a line per variant or sensor have in common: panels and a legend below them.

/// The width of a figure in units of its sheet, whose own is 0 for a screen.
double figure_width(const Sheet& sheet);

/// Whether a figure has room for more panels beside each other than a column of a paper.
bool is_wide(const Sheet& sheet);

/// Panels of one size, filled row by row, and a legend below them. All in units of the sheet.
struct PanelGrid {
  std::size_t columns;  ///< Panels beside each other.
  double left, top;     ///< Of the plot of the first panel.
  double plot_width, plot_height, panel_width, panel_height;
  std::size_t legend_columns;  ///< Entries beside each other.
  double legend_width, legend_line, legend_top;
  double width, height;  ///< Of the figure.
};

/// The grid of `panels` panels whose plots are `aspect` times as high as wide, with the legend
/// `labels`, below a title of `title_height`.
PanelGrid panel_grid(const Sheet& sheet, std::size_t panels, std::size_t columns, double aspect,
                     const std::vector<std::string>& labels, double title_height);

/// The plot of the panel `index`.
Plot plot_of(const PanelGrid& grid, std::size_t index, const Interval& x_range,
             const Interval& y_range);

/// Writes what a panel shows: `above` its plot and `below` it, under the ticks.
void draw_panel_texts(Drawing& drawing, const Plot& plot, const std::string& above,
                      const std::string& below);

/// Writes what goes upwards beside the first panel of a row; a title says it already.
void draw_side_text(Drawing& drawing, const PanelGrid& grid, std::size_t index, const Plot& plot,
                    const std::string& text);

/// Ticks at the powers of ten on an axis of decimal logarithms.
void draw_decade_ticks(Drawing& drawing, const Plot& plot);

/// Draws a line through (xs[i], ys[i]), which are values of `plot`, with the look of `series`.
/// Every `marker_every`-th point has a marker; those of several series are at other points.
void draw_series(Drawing& drawing, const Plot& plot, const std::vector<double>& xs,
                 const std::vector<double>& ys, std::size_t series, std::size_t marker_every);

void draw_panel_legend(Drawing& drawing, const PanelGrid& grid,
                       const std::vector<std::string>& labels);

/// Labels for lines as a legend has room for.
std::vector<std::string> line_labels(const std::vector<std::string>& names);

/// Whether rows are of one variant alone: then a figure has a line per sensor, and one of all
/// sensors together, else a line per variant, of all sensors together.
template <class Row>
bool has_one_variant(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    if (row.variant != rows.front().variant) return false;
  }
  return true;
}

/// The name of the line of a row; empty if it has none.
template <class Row>
std::string line_name(const Row& row, bool is_one_variant) {
  if (is_one_variant) return row.sensor.empty() ? "all sensors" : row.sensor;
  return row.sensor.empty() ? row.variant : "";
}

}  // namespace croon::experiments
