#include <algorithm>
#include <map>

#include "experiments/report/panels.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

/// The names of variants or steps, in order of first appearance.
std::vector<std::string> names_in(const std::vector<StepTime>& times, std::string StepTime::*name) {
  std::vector<std::string> names;
  for (const StepTime& time : times) {
    if (std::find(names.begin(), names.end(), time.*name) == names.end()) {
      names.push_back(time.*name);
    }
  }
  return names;
}

}  // namespace

Drawing times_chart(const std::vector<StepTime>& times, const FigureOptions& options) {
  constexpr double kPitch = 3.2;  // Of bars, in multiples of the size of text.
  constexpr double kBar = 1.4;    // Height of a bar; its name is above it.
  const double text = options.sheet.small();
  const std::vector<std::string> variants = names_in(times, &StepTime::variant);
  const std::vector<std::string> steps = names_in(times, &StepTime::step);
  std::map<std::string, double> totals;
  double max_total = 1e-3;  // Ticks of microseconds would have too many digits.
  for (const StepTime& time : times) {
    max_total = std::max(max_total, totals[time.variant] += time.median_s);
  }
  const double height = kPitch * text * static_cast<double>(variants.size());
  const std::vector<std::string> labels = line_labels(steps);
  auto [grid, drawing] = panel_figure(
      options.sheet, "Wall time of the steps of a trial, in s",
      "Medians over trials, without work done once per scene; steps in the order of the legend", 1,
      1, height / plot_width_of(options.sheet, 1), labels);
  const Axis axis = round_axis(0.0, max_total, is_wide(options.sheet) ? 9 : 5);
  const Plot plot = plot_of(grid, 0, {axis.low, axis.high}, {0.0, 1.0});
  for (const double tick : axis.ticks) {
    plot.draw_x_tick(drawing, tick, fixed_number(tick, axis.decimals), 1.4 * text);
  }
  draw_panel_texts(drawing, plot, "", "median time, s");
  const std::vector<std::string> names = line_labels(variants);
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const double bar = plot.top + kPitch * text * static_cast<double>(v) + 1.5 * text;
    drawing.text(plot.left, bar - 0.35 * text,
                 names[v] + ": " + fixed_number(totals[variants[v]], axis.decimals + 1) + " s",
                 Anchor::start, "small");
    double end = 0.0;
    for (const StepTime& time : times) {
      if (time.variant != variants[v]) continue;
      const auto step = static_cast<std::size_t>(std::find(steps.begin(), steps.end(), time.step) -
                                                 steps.begin());
      const double left = plot.x(end);
      end += time.median_s;
      const double width = plot.x(end) - left;
      draw_bar(drawing, left, bar, width, kBar * text, step);
      // Segments must be distinguishable without colours, hence the markers.
      const double radius = 0.25 * text;
      if (width > 3.0 * radius) {
        draw_marker(drawing, left + width / 2.0, bar + kBar * text / 2.0, radius, step);
      }
    }
  }
  draw_panel_legend(drawing, grid, labels, SeriesMark::bar);
  return drawing;
}

}  // namespace croon::experiments
