#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/report/plots.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {

// Common parts of figures: titles, and for a line per variant or sensor panels, bands and a legend.

/// The title of a figure and the explanation below it, broken into lines that fit its width. Sheets
/// without titles show neither; both are then only in the description of the drawing.
class FigureTitle {
 public:
  FigureTitle(const std::string& title, const std::string& explanation, const Sheet& sheet,
              double width);

  /// The height of the lines; 0 if the sheet has no title.
  double height() const;

  /// Draws the lines from `top` downwards.
  void draw(Drawing& drawing, double left, double top) const;

 private:
  Sheet sheet_;
  std::vector<std::string> title_, explanation_;
};

/// Whether a figure has space for more panels per row than a column of a paper.
bool is_wide(const Sheet& sheet);

/// Panels of equal size, filled row by row, with a legend below them. All in units of the sheet.
struct PanelGrid {
  std::size_t columns;  ///< Panels per row.
  double left, top;     ///< Position of the plot of the first panel.
  double plot_width, plot_height, panel_width, panel_height;
  std::size_t legend_columns;  ///< Entries per row.
  double legend_width, legend_line, legend_top;
  double width;  ///< Of the figure.
};

/// A figure with its title and description, and the grid for its panels.
struct PanelFigure {
  PanelGrid grid;
  Drawing drawing;
};

/// The width of the plots of a figure with `columns` panels per row.
double plot_width_of(const Sheet& sheet, std::size_t columns);

/// The figure of `panels` panels, at most `columns` per row, whose plots have height `aspect` times
/// their width, with space for the legend `labels`.
PanelFigure panel_figure(const Sheet& sheet, const std::string& title,
                         const std::string& explanation, std::size_t panels, std::size_t columns,
                         double aspect, const std::vector<std::string>& labels);

/// The plot of the panel `index`.
Plot plot_of(const PanelGrid& grid, std::size_t index, const Interval& x_range,
             const Interval& y_range);

/// Writes the texts of a panel: `above` its plot, and `below` it under the ticks.
void draw_panel_texts(Drawing& drawing, const Plot& plot, const std::string& above,
                      const std::string& below);

/// Writes the label of the y axis beside the first panel of a row, unless the figure has a title.
void draw_side_text(Drawing& drawing, const PanelGrid& grid, std::size_t index, const Plot& plot,
                    const std::string& text);

/// Ticks at every 20 % on a y axis of shares.
void draw_percent_ticks(Drawing& drawing, const Plot& plot);

/// Ticks at the powers of ten on an axis of decimal logarithms.
void draw_decade_ticks(Drawing& drawing, const Plot& plot);

/// Draws a line through (xs[i], ys[i]), which are values of `plot`, in the style of `series`. Every
/// `marker_every`-th point has a marker, at different points for different series.
void draw_series(Drawing& drawing, const Plot& plot, const std::vector<double>& xs,
                 const std::vector<double>& ys, std::size_t series, std::size_t marker_every);

/// Draws a line through (xs[i], ys[i]) in the style of `series`, clamped to the plot, with gaps
/// where a value is NaN.
void draw_parts(Drawing& drawing, const Plot& plot, const std::vector<double>& xs,
                const std::vector<double>& ys, std::size_t series);

void draw_panel_legend(Drawing& drawing, const PanelGrid& grid,
                       const std::vector<std::string>& labels, SeriesMark mark = SeriesMark::line);

// Bands around the lines: the intervals of shares.

/// The intervals of shares; std::nullopt for a share without an interval.
std::vector<std::optional<Interval>> intervals_of(const std::vector<Share>& shares);

/// Indices of the lines drawn with a band: all of `lines` if there are at most four, otherwise only
/// the first, because more overlapping bands would hide the lines.
std::vector<std::size_t> lines_with_band(std::size_t lines);

/// Describes the bands of the lines `with_band`; `names` are the names of all lines.
std::string band_sentence(const std::vector<std::string>& names,
                          const std::vector<std::size_t>& with_band);

/// The names of lines, shortened to fit a legend.
std::vector<std::string> line_labels(const std::vector<std::string>& names);

/// Whether all rows are of one variant. A figure then has a line per sensor and one for all sensors
/// together, otherwise a line per variant, over all sensors.
template <class Row>
bool has_one_variant(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    if (row.variant != rows.front().variant) return false;
  }
  return true;
}

/// The name of a row's line; empty if it is not drawn.
template <class Row>
std::string line_name(const Row& row, bool is_one_variant) {
  if (is_one_variant) return row.sensor.empty() ? "all sensors" : row.sensor;
  return row.sensor.empty() ? row.variant : "";
}

}  // namespace croon::experiments
