#include "experiments/report/panels.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

// The margins beside a plot, in multiples of the size of small text.
constexpr double kLeft = 4.0;
constexpr double kRight = 1.5;

/// The width of a figure in units of its sheet; a default width for a screen, whose sheet has width
/// 0.
double figure_width(const Sheet& sheet) { return sheet.width > 0.0 ? sheet.width : 900.0; }

constexpr double kTitleLine = 1.3;  // Line height, in multiples of the title's font size.

/// Breaks the text at spaces into lines of at most `columns` columns.
std::vector<std::string> wrapped(const std::string& text, std::size_t columns) {
  std::vector<std::string> lines = {""};
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::string& line = lines.back();
    if (line.empty()) {
      line = word;
    } else if (text_columns(line) + 1 + text_columns(word) <= columns) {
      line += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

}  // namespace

FigureTitle::FigureTitle(const std::string& title, const std::string& explanation,
                         const Sheet& sheet, double width)
    : sheet_(sheet) {
  if (!sheet.has_title) return;
  const auto columns = static_cast<std::size_t>(width / text_width("x", sheet.small()));
  title_ = wrapped(title, columns * 3 / 4);  // The title is larger or bold.
  explanation_ = wrapped(explanation, columns);
}

double FigureTitle::height() const {
  return kTitleLine * sheet_.title() * static_cast<double>(title_.size() + explanation_.size());
}

void FigureTitle::draw(Drawing& drawing, double left, double top) const {
  double y = top + 0.9 * sheet_.title();
  for (const auto& [lines, style] : {std::pair(&title_, "title"), {&explanation_, "small"}}) {
    for (const std::string& line : *lines) {
      drawing.text(left, y, line, Anchor::start, style);
      y += kTitleLine * sheet_.title();
    }
  }
}

bool is_wide(const Sheet& sheet) {
  return sheet.width <= 0.0 || sheet.width > 1.5 * kOneColumn.width;
}

double plot_width_of(const Sheet& sheet, std::size_t columns) {
  return figure_width(sheet) / static_cast<double>(columns) - kLeft * sheet.small() -
         kRight * sheet.small();
}

PanelFigure panel_figure(const Sheet& sheet, const std::string& title,
                         const std::string& explanation, std::size_t panels, std::size_t columns,
                         double aspect, const std::vector<std::string>& labels) {
  const double text = sheet.small();
  const FigureTitle lines(title, explanation, sheet, figure_width(sheet));
  PanelGrid grid{};
  grid.columns = columns;
  grid.width = figure_width(sheet);
  grid.left = kLeft * text;
  grid.top = lines.height() + 1.8 * text;
  grid.panel_width = grid.width / static_cast<double>(columns);
  grid.plot_width = plot_width_of(sheet, columns);
  grid.plot_height = aspect * grid.plot_width;
  grid.panel_height = grid.plot_height + 5.2 * text;
  double max_label_width = 0.0;
  for (const std::string& label : labels)
    max_label_width = std::max(max_label_width, text_width(label, text));
  grid.legend_width = legend_line(sheet) + max_label_width + 2.0 * text;
  grid.legend_line = 1.6 * text;
  const auto entries = static_cast<double>(std::max<std::size_t>(labels.size(), 1));
  const double fitting = std::floor((grid.width - grid.left) / grid.legend_width);
  grid.legend_columns = static_cast<std::size_t>(std::clamp(fitting, 1.0, entries));
  const double rows = std::ceil(static_cast<double>(panels) / static_cast<double>(columns));
  grid.legend_top = grid.top + rows * grid.panel_height + 0.6 * text;
  const double height =
      labels.empty()
          ? grid.legend_top - 0.6 * text
          : grid.legend_top +
                grid.legend_line * std::ceil(entries / static_cast<double>(grid.legend_columns));
  Drawing drawing(grid.width, height, sheet);
  drawing.describe(title + ". " + explanation + ".");
  drawing.rectangle(0.0, 0.0, grid.width, height, "page");
  lines.draw(drawing, 0.5 * text, 0.3 * text);
  return {grid, std::move(drawing)};
}

Plot plot_of(const PanelGrid& grid, std::size_t index, const Interval& x_range,
             const Interval& y_range) {
  const auto [row, column] = position_in_grid(index, grid.columns);
  return {grid.left + column * grid.panel_width,
          grid.top + row * grid.panel_height,
          grid.plot_width,
          grid.plot_height,
          x_range,
          y_range};
}

void draw_panel_texts(Drawing& drawing, const Plot& plot, const std::string& above,
                      const std::string& below) {
  const double text = drawing.sheet().small();
  const double middle = plot.left + plot.width / 2.0;
  drawing.text(middle, plot.top - 0.5 * text, above, Anchor::middle, "small");
  drawing.text(middle, plot.top + plot.height + 2.9 * text, below, Anchor::middle, "small");
}

void draw_side_text(Drawing& drawing, const PanelGrid& grid, std::size_t index, const Plot& plot,
                    const std::string& text) {
  if (drawing.sheet().has_title || index % grid.columns != 0) return;
  drawing.text(plot.left - 2.9 * drawing.sheet().small(), plot.top + plot.height / 2.0, text,
               Anchor::middle, "small", -90.0);
}

void draw_percent_ticks(Drawing& drawing, const Plot& plot) {
  for (const double ratio : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    plot.draw_y_tick(drawing, ratio, fixed_number(100.0 * ratio, 0), 0.7 * drawing.sheet().small(),
                     ratio == 0.0 ? "zero" : "grid");
  }
}

void draw_decade_ticks(Drawing& drawing, const Plot& plot) {
  for (double exponent = std::ceil(plot.x_range.low); exponent <= plot.x_range.high; ++exponent) {
    plot.draw_x_tick(drawing, exponent, shortest_number(std::pow(10.0, exponent)),
                     1.4 * drawing.sheet().small());
  }
}

void draw_series(Drawing& drawing, const Plot& plot, const std::vector<double>& xs,
                 const std::vector<double>& ys, std::size_t series, std::size_t marker_every) {
  std::vector<Corner> curve;
  for (std::size_t i = 0; i < ys.size(); ++i) curve.push_back({plot.x(xs[i]), plot.y(ys[i])});
  drawing.polyline(curve, "curve " + series_style(series));
  for (std::size_t i = series % marker_every; i < curve.size(); i += marker_every) {
    draw_marker(drawing, curve[i][0], curve[i][1], 0.25 * drawing.sheet().small(), series);
  }
}

void draw_parts(Drawing& drawing, const Plot& plot, const std::vector<double>& xs,
                const std::vector<double>& ys, std::size_t series) {
  std::vector<Corner> part;
  const auto finish = [&] {
    if (part.size() > 1) drawing.polyline(part, "curve " + series_style(series));
    if (part.size() == 1) draw_marker(drawing, part[0][0], part[0][1], 2.0, series);
    part.clear();
  };
  for (std::size_t i = 0; i < xs.size(); ++i) {
    if (std::isnan(ys[i])) {
      finish();
      continue;
    }
    part.push_back({plot.x(xs[i]), plot.y_inside(ys[i])});
  }
  finish();
}

void draw_panel_legend(Drawing& drawing, const PanelGrid& grid,
                       const std::vector<std::string>& labels, SeriesMark mark) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto [row, column] = position_in_grid(i, grid.legend_columns);
    draw_legend_entry(drawing, grid.left + grid.legend_width * column,
                      grid.legend_top + grid.legend_line * row, i, labels[i], mark);
  }
}

std::vector<std::string> line_labels(const std::vector<std::string>& names) {
  constexpr std::size_t kColumns = 30;
  return distinct_labels(names, kColumns);
}

std::vector<std::optional<Interval>> intervals_of(const std::vector<Share>& shares) {
  std::vector<std::optional<Interval>> intervals;
  for (const Share& share : shares) intervals.push_back(share.interval);
  return intervals;
}

std::vector<std::size_t> lines_with_band(std::size_t lines) {
  constexpr std::size_t kMaxBands = 4;
  std::vector<std::size_t> all(lines > kMaxBands ? 1 : lines);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::string band_sentence(const std::vector<std::string>& names,
                          const std::vector<std::size_t>& with_band) {
  const bool have_all = with_band.size() == names.size();
  return (have_all ? "bands:" : "band of " + names[with_band.front()] + ":") +
         " 95 % interval over scenes (requires at least " + std::to_string(kMinScenes) + " scenes)";
}

}  // namespace croon::experiments
