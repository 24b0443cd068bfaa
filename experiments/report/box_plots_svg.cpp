#include <cmath>
#include <set>
#include <stdexcept>

#include "experiments/report/box_groups.hpp"
#include "experiments/report/box_layout.hpp"
#include "experiments/report/plots.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"
#include "framework/picture/svg.hpp"

namespace croon::experiments {

namespace {

constexpr double kBoxWidth = 13.0;  // Pixels.
constexpr std::size_t kMaxScenes = 12;
constexpr std::size_t kMaxKinds = 20;

void draw_frame(Svg& svg, const BoxPanel& panel, const Measure& measure) {
  for (const double tick : panel.axis.ticks) {
    const double y = panel.y(tick);
    svg.line(panel.left, y, panel.left + panel.width, y, tick == 0.0 ? "zero" : "grid");
    svg.text(panel.left - 6.0, y + 4.0, fixed_number(tick, panel.axis.decimals), Anchor::end,
             "small");
  }
  svg.text(panel.left, panel.top - 10.0, std::string(measure.name) + ", " + measure.unit,
           Anchor::start, "title");
}

void draw_box(Svg& svg, const BoxPanel& panel, double x, const BoxSeries& series,
              std::size_t measure) {
  const BoxPlot box = box_plot(values_of(series.deviations, measure));
  const std::string colour = " c" + std::to_string(series.colour % kChartColours);
  const double left = x - kBoxWidth / 2.0;
  const double right = x + kBoxWidth / 2.0;
  const double top = panel.y(box.upper_quartile);
  const double bottom = panel.y(box.lower_quartile);
  svg.line(x, panel.y(box.upper_whisker), x, top, "line" + colour);
  svg.line(x, bottom, x, panel.y(box.lower_whisker), "line" + colour);
  for (const double end : {box.lower_whisker, box.upper_whisker}) {
    svg.line(left + 3.0, panel.y(end), right - 3.0, panel.y(end), "line" + colour);
  }
  svg.rectangle(left, top, kBoxWidth, bottom - top, "box" + colour);
  svg.line(left, panel.y(box.median), right, panel.y(box.median), "median" + colour);
  // Of dots that look the same one is enough, or a long run makes a file of many megabytes.
  std::set<double> rows;
  for (const double outlier : box.outliers) rows.insert(std::round(2.0 * panel.y(outlier)) / 2.0);
  for (const double y : rows) svg.dot(x, y, 1.8, "dot" + colour);
}

void draw_panel(Svg& svg, const BoxLayout& layout, const std::vector<BoxGroup>& groups,
                std::size_t index) {
  const std::size_t measure = kPaperOrder[index];
  const BoxPanel panel = panel_of(layout, groups, index, measure);
  draw_frame(svg, panel, kMeasures[measure]);
  double used = 0.0;
  for (const BoxGroup& group : groups) used += group_width(group);
  // What width is left over goes between the groups.
  const double gap = (layout.plot_width - used) / static_cast<double>(groups.size());
  const double below = panel.top + kPlotHeight + 8.0;
  double left = panel.left + gap / 2.0;
  for (const BoxGroup& group : groups) {
    const double width = group_width(group);
    const double boxes = kBoxPitch * static_cast<double>(group.boxes.size());
    double x = left + (width - boxes) / 2.0 + kBoxPitch / 2.0;
    for (const BoxSeries& box : group.boxes) {
      if (box.deviations.empty()) {
        svg.text(x + 4.0, below - 12.0, "none", Anchor::start, "small", -90.0);
      } else {
        draw_box(svg, panel, x, box, measure);
      }
      svg.text(x + 4.0, below, cut_in_the_middle(box.label, kLabelColumns), Anchor::end, "small",
               -90.0);
      x += kBoxPitch;
    }
    svg.text(left + width / 2.0, below + layout.label_height + 10.0, group.sensor, Anchor::middle,
             "sensor");
    left += width + gap;
  }
}

std::string title_of(const Summary& summary) {
  std::vector<const SummaryRow*> rows;
  for (const SummaryRow& row : summary.rows) rows.push_back(&row);
  const TrialSummary all = pooled(scenes_of(rows));
  const std::string which =
      std::to_string(all.counted) + " of " + std::to_string(all.outcomes.trials) + " trials";
  return all.deviations_from == DeviationsFrom::truth
             ? "Error of the successful trials against the truth (" + which + ")"
             : "Deviation from what all scenes agree on (" + which + ")";
}

/// The meaning of a box.
std::string explanation_of(BoxOf of) {
  const auto of_what = [&] {
    switch (of) {
      case BoxOf::variant:
        return "one variant and sensor, all scenes together";
      case BoxOf::scene:
        return "one sensor in one scene";
      case BoxOf::scene_kind:
        return "one sensor in all scenes of one kind";
      case BoxOf::all_scenes:
        return "one sensor, all scenes together";
    }
    throw std::logic_error("a box of nothing that exists");
  };
  return std::string("A box is ") + of_what() +
         ": quartiles and median; dots lie beyond 1.5 interquartile ranges";
}

}  // namespace

std::string box_plots_svg(const Summary& summary) {
  const BoxOf of = box_of(summary, kMaxScenes, kMaxKinds);
  const std::vector<BoxGroup> groups = box_groups(summary, of);
  const BoxLayout layout = layout_of(groups);
  Svg svg(layout.width(), layout.height(), kChartStyle);
  svg.rectangle(0.0, 0.0, layout.width(), layout.height(), "page");
  svg.text(kMargin, kTitleHeight - 34.0, title_of(summary), Anchor::start, "title");
  svg.text(kMargin, kTitleHeight - 16.0, explanation_of(of), Anchor::start, "small");
  for (std::size_t index = 0; index < kDofs; ++index) draw_panel(svg, layout, groups, index);
  return svg.bytes();
}

}  // namespace croon::experiments
