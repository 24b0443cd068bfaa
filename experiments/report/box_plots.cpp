#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/report/box_drawing.hpp"
#include "experiments/report/panels.hpp"
#include "experiments/report/plots.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {

namespace {

constexpr std::size_t kMaxScenes = 12;
constexpr std::size_t kMaxKinds = 20;

/// The dimensions of a figure that depend on its sheet, in units of the sheet.
struct Lengths {
  double margin, panel_title, axis_width, right, group_gap, sensor_height;
  double max_pitch, min_pitch;  ///< Distance between the centres of neighbouring boxes.
  double min_plot_width;
  std::size_t label_columns;
};

constexpr Lengths kScreenLengths = {16, 26, 58, 16, 18, 22, 22, 22, 260, 30};
constexpr Lengths kPaperLengths = {1, 12, 31, 5, 4, 11, 14, 9, 55, 28};

/// The measure of a panel, as its axis shows it.
struct Panel {
  std::size_t measure;
  std::string title;
  double factor;  ///< Converts the measure's unit to that of the axis.
  Axis axis;
};

/// A figure of panels of equal size.
struct BoxLayout {
  Sheet sheet;
  Lengths lengths;
  double title_height = 0.0;
  std::size_t columns = 1;  ///< Number of panels per row.
  double plot_width = 0.0;
  double plot_height = 190.0;
  double pitch = 0.0;
  double count_height = 0.0;  ///< Height of the numbers of trials below the boxes.
  double label_height = 0.0;  ///< Height of the names below these.
  double above = 0.0;         ///< Space for the numbers of values beyond the axis.
  double below = 0.0;

  std::size_t rows() const { return kDofs / columns; }
  double names_height() const { return count_height + label_height + lengths.sensor_height; }
  double panel_width() const { return lengths.axis_width + plot_width + lengths.right; }
  /// On paper, the panels of a column share the names below the bottom panel.
  double panel_height() const {
    return lengths.panel_title + above + plot_height + below +
           (sheet.is_paper ? 0.4 * sheet.text() : names_height() + lengths.margin);
  }
  double width() const {
    return sheet.width > 0.0 ? sheet.width
                             : 2.0 * lengths.margin + static_cast<double>(columns) * panel_width();
  }
  double height() const {
    return title_height + static_cast<double>(rows()) * panel_height() + lengths.margin +
           (sheet.is_paper ? names_height() : 0.0);
  }
};

/// The width of a group: its boxes, or its name if that is wider.
double group_width(const BoxGroup& group, const BoxLayout& layout, double pitch) {
  return std::max(pitch * static_cast<double>(group.boxes.size()),
                  text_width(group.sensor, layout.sheet.text()));
}

double groups_width(const std::vector<BoxGroup>& groups, const BoxLayout& layout, double pitch) {
  double width = 0.0;
  for (const BoxGroup& group : groups) {
    width += group_width(group, layout, pitch) + layout.lengths.group_gap;
  }
  return width;
}

std::size_t number_of_boxes(const std::vector<BoxGroup>& groups) {
  std::size_t boxes = 0;
  for (const BoxGroup& group : groups) boxes += group.boxes.size();
  return boxes;
}

/// Panels are as wide as their boxes need; wide panels are arranged in two, three or six rows.
void lay_out_for_screen(BoxLayout& layout, const std::vector<BoxGroup>& groups) {
  const std::size_t boxes = number_of_boxes(groups);
  layout.columns = boxes <= 20 ? 3 : boxes <= 48 ? 2 : 1;
  layout.pitch = layout.lengths.max_pitch;
  layout.plot_width =
      std::max(layout.lengths.min_plot_width, groups_width(groups, layout, layout.pitch));
}

/// Chooses the maximum number of panels per row that fits their boxes.
void lay_out_for_paper(BoxLayout& layout, const std::vector<BoxGroup>& groups) {
  const double page = layout.sheet.width - 2.0 * layout.lengths.margin;
  for (const std::size_t columns : {3U, 2U, 1U}) {
    layout.columns = columns;
    layout.plot_width =
        page / static_cast<double>(columns) - layout.lengths.axis_width - layout.lengths.right;
    if (layout.plot_width < layout.lengths.min_plot_width) continue;
    for (layout.pitch = layout.lengths.max_pitch; layout.pitch >= layout.lengths.min_pitch;
         layout.pitch -= 0.25) {
      if (groups_width(groups, layout, layout.pitch) > layout.plot_width) continue;
      // Six panels below each other must fit on a page.
      layout.plot_height = columns == 1 ? 46.0 : std::clamp(0.7 * layout.plot_width, 62.0, 90.0);
      return;
    }
  }
  const double width =
      page - layout.plot_width + groups_width(groups, layout, layout.lengths.min_pitch);
  throw InputError("", "--width",
                   std::to_string(number_of_boxes(groups)) + " boxes with their names need " +
                       fixed_number(std::ceil(width / kPointsPerMm), 0) + " mm, the figure is " +
                       fixed_number(layout.sheet.width / kPointsPerMm, 0) +
                       " mm wide; choose fewer with --sensors or --variants, or a wider figure");
}

std::vector<double> scaled_values(const BoxSeries& box, const Panel& panel) {
  std::vector<double> values = values_of(box.deviations, panel.measure);
  for (double& value : values) value *= panel.factor;
  return values;
}

/// Calls `visit` for each box that has values.
template <class F>
void for_each_box(const std::vector<BoxGroup>& groups, const F& visit) {
  for (const BoxGroup& group : groups) {
    for (const BoxSeries& box : group.boxes) {
      if (!box.deviations.empty()) visit(box);
    }
  }
}

/// The range of a measure: 0 and all values, clipped at the robust limit.
Interval shown_range(const std::vector<BoxGroup>& groups, std::size_t measure) {
  const double limit = robust_limit(groups, measure);
  Interval range = {0.0, 0.0};
  for_each_box(groups, [&](const BoxSeries& box) {
    for (const Measures& deviation : box.deviations) {
      range.low = std::max(std::min(range.low, deviation[measure]), -limit);
      range.high = std::min(std::max(range.high, deviation[measure]), limit);
    }
  });
  return range;
}

bool is_length(std::size_t measure) { return kMeasures[measure].unit == std::string("m"); }

/// The six panels in the order of the paper; all lengths have the same unit.
std::vector<Panel> panels_of(const std::vector<BoxGroup>& groups, const std::string& unit) {
  double max_size = 0.0;
  for (const std::size_t measure : kPaperOrder) {
    if (!is_length(measure)) continue;
    const Interval range = shown_range(groups, measure);
    max_size = std::max({max_size, -range.low, range.high});
  }
  constexpr double kSmall_m = 0.1;
  const bool in_mm = unit.empty() ? max_size < kSmall_m : unit == "mm";
  std::vector<Panel> panels;
  for (const std::size_t measure : kPaperOrder) {
    const bool is_in_mm = is_length(measure) && in_mm;
    const double factor = is_in_mm ? 1000.0 : 1.0;
    const Interval range = shown_range(groups, measure);
    panels.push_back(
        {measure,
         std::string(kMeasures[measure].name) + ", " + (is_in_mm ? "mm" : kMeasures[measure].unit),
         factor, round_axis(factor * range.low, factor * range.high, 5)});
  }
  return panels;
}

Interval range_of(const Axis& axis) { return {axis.low, axis.high}; }

/// Reserves space for the numbers of values beyond the axes.
void make_room_beyond(BoxLayout& layout, const std::vector<Panel>& panels,
                      const std::vector<BoxGroup>& groups) {
  Beyond max_count;
  for (const Panel& panel : panels) {
    for_each_box(groups, [&](const BoxSeries& box) {
      const Beyond beyond = count_beyond(scaled_values(box, panel), range_of(panel.axis));
      max_count.above = std::max(max_count.above, beyond.above);
      max_count.below = std::max(max_count.below, beyond.below);
    });
  }
  layout.above = beyond_height(layout.sheet, layout.pitch, max_count.above);
  layout.below = beyond_height(layout.sheet, layout.pitch, max_count.below);
}

/// The number of values in a box and of its trials: "18/20".
std::string count_text(const BoxSeries& box) {
  return std::to_string(box.deviations.size()) + "/" + std::to_string(box.trials);
}

BoxLayout layout_of(const std::vector<BoxGroup>& groups, const std::vector<Panel>& panels,
                    const Sheet& sheet) {
  BoxLayout layout;
  layout.sheet = sheet;
  layout.lengths = sheet.is_paper ? kPaperLengths : kScreenLengths;
  for (const BoxGroup& group : groups) {
    for (const BoxSeries& box : group.boxes) {
      layout.count_height =
          std::max(layout.count_height, text_width(count_text(box), sheet.small()) + 6.0);
      if (box.label.empty()) continue;
      layout.label_height =
          std::max(layout.label_height, text_width(box.label, sheet.small()) + 6.0);
    }
  }
  sheet.width > 0.0 ? lay_out_for_paper(layout, groups) : lay_out_for_screen(layout, groups);
  make_room_beyond(layout, panels, groups);
  return layout;
}

/// Draws the frame of `panel`, the `index`-th of six, and returns its plot.
Plot draw_frame(Drawing& drawing, const BoxLayout& layout, std::size_t index, const Panel& panel) {
  // With two columns, rotations are on the left and translations on the right.
  const std::size_t rows = layout.rows();
  const std::size_t row = layout.columns == 2 ? index % rows : index / layout.columns;
  const std::size_t column = layout.columns == 2 ? index / rows : index % layout.columns;
  const double left = layout.lengths.margin + static_cast<double>(column) * layout.panel_width() +
                      layout.lengths.axis_width;
  const double title = layout.title_height + static_cast<double>(row) * layout.panel_height() +
                       layout.lengths.panel_title;
  const Axis& axis = panel.axis;
  const Plot plot = {left,       title + layout.above, layout.plot_width, layout.plot_height,
                     {0.0, 1.0}, {axis.low, axis.high}};
  for (const double tick : axis.ticks) {
    plot.draw_y_tick(drawing, tick, fixed_number(tick, axis.decimals), 0.5 * layout.sheet.small(),
                     tick == 0.0 ? "zero" : "grid");
  }
  drawing.text(left, title - 0.5 * layout.sheet.text(), panel.title, Anchor::start, "title");
  return plot;
}

void draw_panel(Drawing& drawing, const BoxLayout& layout, const std::vector<BoxGroup>& groups,
                std::size_t index, const Panel& panel) {
  const Plot plot = draw_frame(drawing, layout, index, panel);
  const double used = groups_width(groups, layout, layout.pitch) -
                      layout.lengths.group_gap * static_cast<double>(groups.size());
  // Distribute the remaining width between the groups.
  const double gap = (layout.plot_width - used) / static_cast<double>(groups.size());
  const double text = layout.sheet.small();
  const double below = plot.top + plot.height + layout.below + 0.6 * text;
  const bool has_names =
      !layout.sheet.is_paper || (layout.columns == 2 ? index % layout.rows() + 1 == layout.rows()
                                                     : index / layout.columns + 1 == layout.rows());
  double left = plot.left + gap / 2.0;
  for (const BoxGroup& group : groups) {
    const double width = group_width(group, layout, layout.pitch);
    const double boxes = layout.pitch * static_cast<double>(group.boxes.size());
    double x = left + (width - boxes) / 2.0 + layout.pitch / 2.0;
    for (const BoxSeries& box : group.boxes) {
      if (box.deviations.empty()) {
        drawing.text(x + 0.36 * text, plot.top + plot.height - 0.4 * text, "none", Anchor::start,
                     "small", -90.0);
      } else {
        draw_box(drawing, plot, x, layout.pitch, box.colour, scaled_values(box, panel));
      }
      if (has_names) {
        drawing.text(x + 0.36 * text, below, count_text(box), Anchor::end, "small", -90.0);
        drawing.text(x + 0.36 * text, below + layout.count_height, box.label, Anchor::end, "small",
                     -90.0);
      }
      x += layout.pitch;
    }
    if (has_names) {
      drawing.text(left + width / 2.0,
                   below + layout.count_height + layout.label_height + 0.8 * text, group.sensor,
                   Anchor::middle, "sensor");
    }
    left += width + gap;
  }
}

std::string title_of(const Summary& summary) {
  std::vector<const SummaryRow*> rows;
  for (const SummaryRow& row : summary.rows) rows.push_back(&row);
  const TrialSummary all = pooled_counts(scenes_of(rows));
  const std::string which =
      std::to_string(all.counted) + " of " + std::to_string(all.outcomes.trials) + " trials";
  return all.deviations_from == DeviationsFrom::truth
             ? "Error of the successful trials against ground truth (" + which + ")"
             : "Deviation from the consensus of all scenes (" + which + ")";
}

/// The meaning of a box and of the other marks in this figure.
std::string explanation_of(BoxOf of, const std::vector<BoxGroup>& groups,
                           const std::vector<Panel>& panels) {
  static const std::map<BoxOf, const char*> what = {
      {BoxOf::variant, "one variant and sensor, all scenes together"},
      {BoxOf::scene, "one sensor in one scene"},
      {BoxOf::scene_kind, "one sensor in all scenes of one kind"},
      {BoxOf::all_scenes, "one sensor, all scenes together"}};
  bool has_few = false;
  bool has_beyond = false;
  bool has_cut = false;
  for (const Panel& panel : panels) {
    const Interval axis = range_of(panel.axis);
    for_each_box(groups, [&](const BoxSeries& box) {
      const std::vector<double> values = scaled_values(box, panel);
      const Beyond beyond = count_beyond(values, axis);
      has_few = has_few || values.size() < kMinBoxValues;
      has_beyond = has_beyond || beyond.above + beyond.below > 0;
      has_cut = has_cut || is_cut(values, axis);
    });
  }
  std::string text = std::string("A box is ") + what.at(of) +
                     ": quartiles and median; dots lie beyond 1.5 interquartile ranges; n/N: "
                     "n of N trials in the box";
  if (has_few) {
    text += "; fewer than " + std::to_string(kMinBoxValues) + " values are drawn as dots";
  }
  if (has_beyond) text += "; arrowheads show the number of values beyond the axis";
  if (has_cut) text += "; a box or whisker that extends beyond the axis is open there";
  return text;
}

}  // namespace

Drawing box_plots(const Summary& summary, const FigureOptions& options) {
  const BoxOf of = box_of(summary, kMaxScenes, kMaxKinds);
  std::vector<BoxGroup> groups = box_groups(summary, of);
  shorten_labels(groups, (options.sheet.is_paper ? kPaperLengths : kScreenLengths).label_columns);
  const std::vector<Panel> panels = panels_of(groups, options.length_unit);
  BoxLayout layout = layout_of(groups, panels, options.sheet);
  const std::string explanation = explanation_of(of, groups, panels);
  const FigureTitle title(title_of(summary), explanation, options.sheet,
                          layout.width() - 2.0 * layout.lengths.margin);
  layout.title_height = options.sheet.has_title ? title.height() + 26.0 : 0.0;
  Drawing drawing(layout.width(), layout.height(), options.sheet);
  drawing.describe(title_of(summary) + ". " + explanation + ".");
  drawing.rectangle(0.0, 0.0, layout.width(), layout.height(), "page");
  title.draw(drawing, layout.lengths.margin, layout.lengths.margin);
  for (std::size_t i = 0; i < kDofs; ++i) draw_panel(drawing, layout, groups, i, panels[i]);
  return drawing;
}

}  // namespace croon::experiments
