#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/report/plots.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {

namespace {

// Pixels.
constexpr double kMargin = 16.0;
constexpr double kTitleHeight = 62.0;
constexpr double kPanelTitle = 26.0;
constexpr double kAxisWidth = 58.0;
constexpr double kLeastPlotWidth = 260.0;
constexpr double kPlotHeight = 190.0;
constexpr double kBoxWidth = 13.0;
constexpr double kBoxPitch = 22.0;  // From the middle of a box to that of the next.
constexpr double kGroupGap = 18.0;
constexpr double kSensorHeight = 22.0;
constexpr double kLetterWidth = 6.2;

constexpr std::size_t kLabelColumns = 24;
constexpr std::size_t kMaxScenes = 12;
constexpr std::size_t kMaxKinds = 20;

/// The sizes in the picture; all panels are alike.
struct Layout {
  std::size_t columns;  ///< Of panels.
  double plot_width;
  double label_height;  ///< Of the names below the boxes.

  double panel_width() const { return kAxisWidth + plot_width + kMargin; }
  double panel_height() const {
    return kPanelTitle + kPlotHeight + label_height + kSensorHeight + kMargin;
  }
  double width() const { return 2.0 * kMargin + static_cast<double>(columns) * panel_width(); }
  double height() const {
    return kTitleHeight + static_cast<double>(kDofs / columns) * panel_height() + kMargin;
  }
};

/// How wide a group is: its boxes, or its name if that is longer.
double group_width(const BoxGroup& group) {
  return std::max(kBoxPitch * static_cast<double>(group.boxes.size()),
                  kLetterWidth * static_cast<double>(text_columns(group.sensor)));
}

/// The layout that has room for every group.
Layout layout_of(const std::vector<BoxGroup>& groups) {
  std::size_t boxes = 0;
  std::size_t label_columns = 0;
  double width = 0.0;
  for (const BoxGroup& group : groups) {
    boxes += group.boxes.size();
    width += group_width(group) + kGroupGap;
    for (const BoxSeries& box : group.boxes) {
      label_columns = std::max(label_columns, std::min(text_columns(box.label), kLabelColumns));
    }
  }
  const double label_height =
      label_columns == 0 ? 0.0 : kLetterWidth * static_cast<double>(label_columns) + 6.0;
  // Many boxes make wide panels: two rows, three rows or six of them.
  const std::size_t columns = boxes <= 20 ? 3 : boxes <= 48 ? 2 : 1;
  return {columns, std::max(kLeastPlotWidth, width), label_height};
}

/// The axis of a measure, which holds every value and 0.
Axis axis_of(const std::vector<BoxGroup>& groups, std::size_t measure) {
  double low = 0.0;
  double high = 0.0;
  for (const BoxGroup& group : groups) {
    for (const BoxSeries& box : group.boxes) {
      for (const Measures& deviation : box.deviations) {
        low = std::min(low, deviation[measure]);
        high = std::max(high, deviation[measure]);
      }
    }
  }
  return round_axis(low, high, 5);
}

/// Draws the frame of the panel for `measure`, the `index`-th of six, and returns its plot.
Plot draw_frame(Svg& svg, const Layout& layout, std::size_t index, const Measure& measure,
                const Axis& axis) {
  // With two columns, rotations stand left and translations right.
  const std::size_t rows = kDofs / layout.columns;
  const std::size_t row = layout.columns == 2 ? index % rows : index / layout.columns;
  const std::size_t column = layout.columns == 2 ? index / rows : index % layout.columns;
  const double left = kMargin + static_cast<double>(column) * layout.panel_width() + kAxisWidth;
  const double top = kTitleHeight + static_cast<double>(row) * layout.panel_height() + kPanelTitle;
  const Plot plot = {left, top, layout.plot_width, kPlotHeight, {0.0, 1.0}, {axis.low, axis.high}};
  for (const double tick : axis.ticks) {
    plot.draw_y_tick(svg, tick, fixed_number(tick, axis.decimals), 6.0,
                     tick == 0.0 ? "zero" : "grid");
  }
  svg.text(left, top - 10.0, std::string(measure.name) + ", " + measure.unit, Anchor::start,
           "title");
  return plot;
}

void draw_box(Svg& svg, const Plot& plot, double x, const BoxSeries& series, std::size_t measure) {
  const BoxPlot box = box_plot(values_of(series.deviations, measure));
  const std::string colour = " c" + std::to_string(series.colour % kChartColours);
  const double left = x - kBoxWidth / 2.0;
  const double right = x + kBoxWidth / 2.0;
  const double top = plot.y(box.upper_quartile);
  const double bottom = plot.y(box.lower_quartile);
  svg.line(x, plot.y(box.upper_whisker), x, top, "line" + colour);
  svg.line(x, bottom, x, plot.y(box.lower_whisker), "line" + colour);
  for (const double end : {box.lower_whisker, box.upper_whisker}) {
    svg.line(left + 3.0, plot.y(end), right - 3.0, plot.y(end), "line" + colour);
  }
  svg.rectangle(left, top, kBoxWidth, bottom - top, "box" + colour);
  svg.line(left, plot.y(box.median), right, plot.y(box.median), "median" + colour);
  // Of dots that look the same one is enough, or a long run makes a file of many megabytes.
  std::set<double> rows;
  for (const double outlier : box.outliers) rows.insert(std::round(2.0 * plot.y(outlier)) / 2.0);
  for (const double y : rows) svg.dot(x, y, 1.8, "dot" + colour);
}

void draw_panel(Svg& svg, const Layout& layout, const std::vector<BoxGroup>& groups,
                std::size_t index) {
  const std::size_t measure = kPaperOrder[index];
  const Plot plot = draw_frame(svg, layout, index, kMeasures[measure], axis_of(groups, measure));
  double used = 0.0;
  for (const BoxGroup& group : groups) used += group_width(group);
  // What width is left over goes between the groups.
  const double gap = (layout.plot_width - used) / static_cast<double>(groups.size());
  const double below = plot.top + kPlotHeight + 8.0;
  double left = plot.left + gap / 2.0;
  for (const BoxGroup& group : groups) {
    const double width = group_width(group);
    const double boxes = kBoxPitch * static_cast<double>(group.boxes.size());
    double x = left + (width - boxes) / 2.0 + kBoxPitch / 2.0;
    for (const BoxSeries& box : group.boxes) {
      if (box.deviations.empty()) {
        svg.text(x + 4.0, below - 12.0, "none", Anchor::start, "small", -90.0);
      } else {
        draw_box(svg, plot, x, box, measure);
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
  static const std::map<BoxOf, const char*> what = {
      {BoxOf::variant, "one variant and sensor, all scenes together"},
      {BoxOf::scene, "one sensor in one scene"},
      {BoxOf::scene_kind, "one sensor in all scenes of one kind"},
      {BoxOf::all_scenes, "one sensor, all scenes together"}};
  return std::string("A box is ") + what.at(of) +
         ": quartiles and median; dots lie beyond 1.5 interquartile ranges";
}

/// The index of `name` in `names`; added if it is new.
std::size_t index_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<std::size_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return index;
}

/// The label of the box that the deviations of `scene` are in.
std::string label_of(const SummaryRow& row, const SceneSummary& scene, BoxOf of) {
  return of == BoxOf::variant      ? row.variant
         : of == BoxOf::scene      ? scene.scene
         : of == BoxOf::scene_kind ? scene.scene_kind
                                   : "";
}

}  // namespace

BoxOf box_of(const Summary& summary, std::size_t max_scenes, std::size_t max_kinds) {
  std::set<std::string> kinds;
  std::size_t scenes = 0;
  for (const SummaryRow& row : summary.rows) {
    scenes = std::max(scenes, row.scenes.size());
  }
  for (const SceneKindSummary& kind : summary.scene_kinds) kinds.insert(kind.scene_kind);
  if (variants_of(summary).size() > 1) return BoxOf::variant;
  if (scenes > 1 && scenes <= max_scenes) return BoxOf::scene;
  const bool by_kind = scenes > 1 && !kinds.empty() && kinds.size() <= max_kinds;
  return by_kind ? BoxOf::scene_kind : BoxOf::all_scenes;
}

std::vector<BoxGroup> box_groups(const Summary& summary, BoxOf of) {
  // Kinds come in the order of their summaries, all else in that of the rows.
  std::vector<std::string> labels, sensors;
  if (of == BoxOf::scene_kind) {
    for (const SceneKindSummary& kind : summary.scene_kinds) index_of(labels, kind.scene_kind);
  }
  std::vector<std::map<std::size_t, std::vector<Measures>>> boxes;
  for (const SummaryRow& row : summary.rows) {
    const std::size_t sensor = index_of(sensors, row.sensor);
    boxes.resize(sensors.size());
    for (const SceneSummary& scene : row.scenes) {
      std::vector<Measures>& box = boxes[sensor][index_of(labels, label_of(row, scene, of))];
      box.insert(box.end(), scene.deviations.begin(), scene.deviations.end());
    }
  }
  std::vector<BoxGroup> groups;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    groups.push_back({sensors[i], {}});
    for (const auto& [label, deviations] : boxes[i]) {
      groups[i].boxes.push_back({labels[label], label, deviations});
    }
  }
  return groups;
}

std::string box_plots_svg(const Summary& summary) {
  const BoxOf of = box_of(summary, kMaxScenes, kMaxKinds);
  const std::vector<BoxGroup> groups = box_groups(summary, of);
  const Layout layout = layout_of(groups);
  Svg svg(layout.width(), layout.height(), kChartStyle);
  svg.rectangle(0.0, 0.0, layout.width(), layout.height(), "page");
  svg.text(kMargin, kTitleHeight - 34.0, title_of(summary), Anchor::start, "title");
  svg.text(kMargin, kTitleHeight - 16.0, explanation_of(of), Anchor::start, "small");
  for (std::size_t index = 0; index < kDofs; ++index) draw_panel(svg, layout, groups, index);
  return svg.bytes();
}

}  // namespace croon::experiments
