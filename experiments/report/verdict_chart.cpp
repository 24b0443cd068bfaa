#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/report/panels.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

/// A panel and the number that it shows.
struct AcceptancePanel {
  const char* title;
  int (*count)(const AcceptanceCounts& counts);
};

constexpr std::array kAcceptancePanels = {
    AcceptancePanel{"accepted and right",
                    [](const AcceptanceCounts& counts) { return counts.accepted_right; }},
    AcceptancePanel{"accepted and wrong",
                    [](const AcceptanceCounts& counts) { return counts.accepted_wrong; }},
    AcceptancePanel{"rejected and right",
                    [](const AcceptanceCounts& counts) { return counts.rejected_right; }},
    AcceptancePanel{"rejected and wrong", [](const AcceptanceCounts& counts) {
                      return counts.rejected_wrong + counts.failed;
                    }}};

/// The rows drawn as lines, each with its name.
std::vector<std::pair<std::string, const AcceptanceRow*>> acceptance_lines(
    const AcceptanceCurve& acceptance) {
  const bool is_one_variant = has_one_variant(acceptance.rows);
  std::vector<std::pair<std::string, const AcceptanceRow*>> lines;
  for (const AcceptanceRow& row : acceptance.rows) {
    const std::string name = line_name(row, is_one_variant);
    if (!name.empty()) lines.emplace_back(name, &row);
  }
  return lines;
}

/// The share of the trials in the panel, over the thresholds, in %.
std::vector<double> percents(const AcceptanceRow& row, const AcceptancePanel& panel) {
  std::vector<double> shares;
  for (const AcceptanceCounts& counts : row.at_thresholds) {
    shares.push_back(100.0 * panel.count(counts) / counts.trials());
  }
  return shares;
}

/// Draws the frame of a panel: the decimal logarithm of the threshold divided by the bounds on the
/// x axis, the share of all trials on the y axis.
void draw_acceptance_panel(Drawing& drawing, const Plot& plot, const Axis& axis,
                           const char* title) {
  const double text = drawing.sheet().small();
  for (const double tick : axis.ticks) {
    plot.draw_y_tick(drawing, tick, fixed_number(tick, axis.decimals), 0.7 * text,
                     tick == 0.0 ? "zero" : "grid");
  }
  draw_decade_ticks(drawing, plot);
  drawing.line(plot.x(0.0), plot.top, plot.x(0.0), plot.top + plot.height, "zero");
  draw_panel_texts(drawing, plot, title, "threshold / bounds");
}

}  // namespace

Drawing acceptance_chart(const AcceptanceCurve& acceptance, const SuccessBounds& bounds,
                         const FigureOptions& options) {
  constexpr const char* kTitle = "Right and wrong poses, accepted and rejected, in % of all trials";
  constexpr int kTicks = 4;
  constexpr std::size_t kMarkerEvery = 4;
  const auto lines = acceptance_lines(acceptance);
  std::vector<std::string> names;
  for (const auto& line : lines) names.push_back(line.first);
  const std::vector<std::string> labels = line_labels(names);
  const std::string explanation =
      "A pose is wrong if its error exceeds the threshold, a multiple of the bounds " +
      shortest_number(bounds.rotation_deg) + " deg and " + shortest_number(bounds.translation_m) +
      " m (vertical line); a trial without a pose counts as rejected and wrong";
  auto [grid, drawing] = panel_figure(options.sheet, kTitle, explanation, kAcceptancePanels.size(),
                                      2, is_wide(options.sheet) ? 0.62 : 1.0, labels);
  std::vector<double> exponents;
  for (const SuccessBounds& threshold : acceptance.thresholds) {
    exponents.push_back(std::log10(threshold.rotation_deg / bounds.rotation_deg));
  }
  for (std::size_t p = 0; p < kAcceptancePanels.size(); ++p) {
    // Each panel has its own axis: rare outcomes matter most.
    double max_share = 1.0;
    for (const auto& [name, row] : lines) {
      const std::vector<double> shares = percents(*row, kAcceptancePanels[p]);
      max_share = std::max(max_share, *std::max_element(shares.begin(), shares.end()));
    }
    const Axis axis = round_axis(0.0, max_share, kTicks);
    const Plot plot =
        plot_of(grid, p, {exponents.front(), exponents.back()}, {axis.low, axis.high});
    draw_acceptance_panel(drawing, plot, axis, kAcceptancePanels[p].title);
    draw_side_text(drawing, grid, p, plot, "share of all trials, %");
    for (std::size_t i = 0; i < lines.size(); ++i) {
      draw_series(drawing, plot, exponents, percents(*lines[i].second, kAcceptancePanels[p]), i,
                  kMarkerEvery);
    }
  }
  draw_panel_legend(drawing, grid, labels);
  return drawing;
}

}  // namespace croon::experiments
