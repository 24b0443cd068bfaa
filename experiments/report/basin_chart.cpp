#include <algorithm>
#include <cmath>

#include "experiments/report/bands.hpp"
#include "experiments/report/figure_title.hpp"
#include "experiments/report/plots.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {
namespace {

/// The layout, in units of the sheet.
struct BasinLayout {
  Plot plot;
  double width, height;
  std::size_t legend_columns;  ///< Entries per row below the plot; 0: right of the plot.
  double legend_width;         ///< Width of an entry.
};

constexpr double kScreenWidth = 890.0;
constexpr double kScreenLegend = 250.0;
constexpr std::size_t kLabelColumns = 30;

double legend_height(const Sheet& sheet) { return sheet.is_paper ? 1.25 * sheet.small() : 20.0; }

BasinLayout layout_of(const Sheet& sheet, const Axis& sizes, const std::vector<std::string>& labels,
                      double title_height) {
  const double text = sheet.small();
  BasinLayout layout{};
  Plot& plot = layout.plot;
  plot.x_range = {sizes.low, sizes.high};
  plot.y_range = {0.0, 1.0};
  plot.left = sheet.is_paper ? 3.6 * text : 56.0;
  plot.top = title_height + 0.9 * text;
  const double axis_height = sheet.is_paper ? 3.6 * text : 50.0;
  const auto rows = static_cast<double>(labels.size());
  if (sheet.width <= 0.0) {
    plot.width = kScreenWidth - plot.left - 24.0 - kScreenLegend;
    plot.height = 300.0;
    layout.width = kScreenWidth;
    layout.height = plot.top + std::max(plot.height, legend_height(sheet) * rows) + axis_height;
    return layout;
  }
  plot.width = sheet.width - plot.left - 1.5 * text;
  plot.height = std::min(0.6 * plot.width, 170.0);
  double max_label_width = 0.0;
  for (const std::string& label : labels)
    max_label_width = std::max(max_label_width, text_width(label, text));
  layout.legend_width = legend_line(sheet) + max_label_width + 1.5 * text;
  layout.legend_columns = static_cast<std::size_t>(
      std::clamp(std::floor(plot.width / layout.legend_width), 1.0, std::max(rows, 1.0)));
  layout.width = sheet.width;
  layout.height =
      plot.top + plot.height + axis_height +
      legend_height(sheet) * std::ceil(rows / static_cast<double>(layout.legend_columns));
  return layout;
}

void draw_frame(Drawing& drawing, const Plot& plot, const Axis& sizes, const Sweep& sweep) {
  const double text = drawing.sheet().small();
  for (const double ratio : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    plot.draw_y_tick(drawing, ratio, fixed_number(100.0 * ratio, 0), 0.7 * text,
                     ratio == 0.0 ? "zero" : "grid");
  }
  for (const double size : sizes.ticks) {
    plot.draw_x_tick(drawing, size, fixed_number(size, sizes.decimals), 1.4 * text);
  }
  const std::string what = sweep.of == SweepOf::rotation ? "rotation" : "translation";
  drawing.text(plot.left + plot.width / 2.0, plot.top + plot.height + 2.8 * text,
               what + " of the initial guess from its centre, " + size_unit(sweep), Anchor::middle,
               "small");
  // Without a title the axis needs a label.
  if (drawing.sheet().has_title) return;
  drawing.text(text, plot.top + plot.height / 2.0, "success, %", Anchor::middle, "small", -90.0);
}

void draw_curve(Drawing& drawing, const Plot& plot, const Sweep& sweep, const BasinRow& row,
                std::size_t index) {
  std::vector<Corner> curve;
  for (std::size_t level = 0; level < row.levels.size(); ++level) {
    const Share& share = row.levels[level];
    if (share.trials == 0) continue;
    curve.push_back({plot.x(level_size(sweep, static_cast<int>(level))), plot.y(share.ratio)});
  }
  drawing.polyline(curve, "curve " + series_style(index));
  for (const auto& [x, y] : curve) {
    draw_marker(drawing, x, y, 0.27 * drawing.sheet().small(), index);
  }
}

void draw_legend(Drawing& drawing, const BasinLayout& layout, std::size_t index,
                 const std::string& label) {
  const Plot& plot = layout.plot;
  const double line = legend_height(drawing.sheet());
  if (layout.legend_columns == 0) {
    draw_legend_entry(drawing, plot.left + plot.width + 24.0,
                      plot.top + 8.0 + line * static_cast<double>(index), index, label);
    return;
  }
  const auto [row, column] = position_in_grid(index, layout.legend_columns);
  draw_legend_entry(drawing, plot.left + layout.legend_width * column,
                    plot.top + plot.height + 4.0 * drawing.sheet().small() + line * row, index,
                    label);
}

}  // namespace

Drawing basin_chart(const Basin& basin, const FigureOptions& options) {
  constexpr const char* kTitle = "Success in % over the perturbation of the initial guess";
  std::vector<const BasinRow*> rows;
  std::vector<std::string> names;
  for (const BasinRow& row : basin.rows) {
    if (!row.sensor.empty()) continue;
    rows.push_back(&row);
    names.push_back(row.variant);
  }
  const std::vector<std::string> labels = distinct_labels(names, kLabelColumns);
  const std::vector<std::size_t> with_band = lines_with_band(rows.size());
  const std::string explanation =
      "All sensors and scenes together; " + band_sentence(labels, with_band);
  const Sheet& sheet = options.sheet;
  const Axis sizes =
      round_axis(basin.sweep.first, basin.sweep.last, sheet.width == kOneColumn.width ? 6 : 9);
  const FigureTitle title(kTitle, explanation, sheet,
                          sheet.width > 0.0 ? sheet.width : kScreenWidth);
  const BasinLayout layout = layout_of(sheet, sizes, labels, title.height());
  Drawing drawing(layout.width, layout.height, sheet);
  drawing.describe(std::string(kTitle) + ". " + explanation + ".");
  drawing.rectangle(0.0, 0.0, layout.width, layout.height, "page");
  title.draw(drawing, 0.5 * sheet.small(), 0.3 * sheet.small());
  draw_frame(drawing, layout.plot, sizes, basin.sweep);
  std::vector<double> levels;
  for (int level = 0; level < basin.sweep.levels; ++level) {
    levels.push_back(level_size(basin.sweep, level));
  }
  for (const std::size_t i : with_band) {
    draw_band(drawing, layout.plot, levels, intervals_of(rows[i]->levels), i);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    draw_curve(drawing, layout.plot, basin.sweep, *rows[i], i);
    draw_legend(drawing, layout, i, labels[i]);
  }
  return drawing;
}

}  // namespace croon::experiments
