#include <array>

#include "experiments/report/panels.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

constexpr std::size_t kCoveragePanels = 6;

/// A line: its name, and its rows by Dof.
struct CoverageLine {
  std::string name;
  std::array<const CoverageRow*, kCoveragePanels> rows = {};
};

/// The lines, with that of all sensors last.
std::vector<CoverageLine> coverage_lines(const Coverage& coverage) {
  const bool is_one_variant = has_one_variant(coverage.rows);
  std::vector<CoverageLine> lines;
  for (const CoverageRow& row : coverage.rows) {
    const std::string name = row.dof ? line_name(row, is_one_variant) : "";
    if (name.empty()) continue;
    if (*row.dof == Dof::roll) lines.push_back({name, {}});
    lines.back().rows.at(static_cast<std::size_t>(*row.dof)) = &row;
  }
  return lines;
}

/// Draws the frame of the panel of a degree of freedom: the level of the interval on the x axis,
/// the share of trials whose interval contains ground truth on the y axis.
void coverage_panel(Drawing& drawing, const Plot& plot, std::size_t dof) {
  const double text = drawing.sheet().small();
  for (const double ratio : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const std::string percent = fixed_number(100.0 * ratio, 0);
    plot.draw_y_tick(drawing, ratio, percent, 0.7 * text, ratio == 0.0 ? "zero" : "grid");
    plot.draw_x_tick(drawing, ratio, percent, 1.4 * text);
  }
  drawing.line(plot.x(0.0), plot.y(0.0), plot.x(1.0), plot.y(1.0), "zero");
  draw_panel_texts(drawing, plot, kDofNames.at(dof), "level of the interval, %");
}

}  // namespace

Drawing coverage_chart(const Coverage& coverage, const FigureOptions& options) {
  constexpr const char* kTitle = "Intervals that contain ground truth, in % of accepted trials";
  const std::vector<CoverageLine> lines = coverage_lines(coverage);
  std::vector<std::string> names;
  for (const CoverageLine& line : lines) names.push_back(line.name);
  const std::vector<std::string> labels = line_labels(names);
  // Bands of sensors overlap, so only the line of all sensors has one.
  const std::vector<std::size_t> with_band = {lines.size() - 1};
  const std::string explanation = "On the diagonal covariances are correct, above it too large; " +
                                  band_sentence(labels, with_band);
  auto [grid, drawing] = panel_figure(options.sheet, kTitle, explanation, kCoveragePanels,
                                      is_wide(options.sheet) ? 3 : 2, 1.0, labels);
  const std::vector<double> levels(kCoverageLevels.begin(), kCoverageLevels.end());
  for (std::size_t dof = 0; dof < kCoveragePanels; ++dof) {
    const Plot plot = plot_of(grid, dof, {0.0, 1.0}, {0.0, 1.0});
    coverage_panel(drawing, plot, dof);
    draw_side_text(drawing, grid, dof, plot, "contain ground truth, %");
    for (const std::size_t i : with_band) {
      draw_band(drawing, plot, levels, intervals_of(lines[i].rows.at(dof)->held), i);
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::vector<double> ratios;
      for (const Share& share : lines[i].rows.at(dof)->held) ratios.push_back(share.ratio);
      draw_series(drawing, plot, levels, ratios, i, 1);
    }
  }
  draw_panel_legend(drawing, grid, labels);
  return drawing;
}

}  // namespace croon::experiments
