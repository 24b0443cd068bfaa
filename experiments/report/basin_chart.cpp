#include "experiments/report/panels.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

void draw_frame(Drawing& drawing, const Plot& plot, const Axis& sizes, const Sweep& sweep) {
  const double text = drawing.sheet().small();
  draw_percent_ticks(drawing, plot);
  for (const double size : sizes.ticks) {
    plot.draw_x_tick(drawing, size, fixed_number(size, sizes.decimals), 1.4 * text);
  }
  const std::string what = sweep.of == SweepOf::rotation ? "rotation" : "translation";
  draw_panel_texts(drawing, plot, "",
                   what + " of the initial guess from its centre, " + size_unit(sweep));
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
  const std::vector<std::string> labels = line_labels(names);
  const std::vector<std::size_t> with_band = lines_with_band(rows.size());
  const std::string explanation =
      "All sensors and scenes together; " + band_sentence(labels, with_band);
  const bool has_space = is_wide(options.sheet);
  const Axis sizes = round_axis(basin.sweep.first, basin.sweep.last, has_space ? 9 : 6);
  auto [grid, drawing] =
      panel_figure(options.sheet, kTitle, explanation, 1, 1, has_space ? 0.37 : 0.6, labels);
  const Plot plot = plot_of(grid, 0, {sizes.low, sizes.high}, {0.0, 1.0});
  draw_frame(drawing, plot, sizes, basin.sweep);
  draw_side_text(drawing, grid, 0, plot, "success, %");
  std::vector<double> levels;
  for (int level = 0; level < basin.sweep.levels; ++level) {
    levels.push_back(level_size(basin.sweep, level));
  }
  for (const std::size_t i : with_band) {
    draw_band(drawing, plot, levels, intervals_of(rows[i]->levels), i);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    draw_curve(drawing, plot, basin.sweep, *rows[i], i);
  }
  draw_panel_legend(drawing, grid, labels);
  return drawing;
}

}  // namespace croon::experiments
