#pragma once

#include <cstddef>
#include <vector>

#include "experiments/report/box_groups.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {

// Pixels; what drawing and layout share.
inline constexpr double kMargin = 16.0;
inline constexpr double kTitleHeight = 62.0;
inline constexpr double kPlotHeight = 190.0;
inline constexpr double kBoxPitch = 22.0;  ///< From the middle of a box to that of the next.
inline constexpr std::size_t kLabelColumns = 24;

/// The sizes in the picture; all panels are alike.
struct BoxLayout {
  std::size_t columns;  ///< Of panels.
  double plot_width;
  double label_height;  ///< Of the names below the boxes.

  double panel_width() const;
  double panel_height() const;
  double width() const;
  double height() const;
};

/// The frame of one panel.
struct BoxPanel {
  double left;  ///< Of the plot, right of the axis.
  double top;   ///< Of the plot, below the title.
  double width;
  Axis axis;

  /// The height at which a value is drawn.
  double y(double value) const;
};

/// How wide a group is: its boxes, or its name if that is longer.
double group_width(const BoxGroup& group);

/// The layout that has room for every group.
BoxLayout layout_of(const std::vector<BoxGroup>& groups);

/// The frame of the panel for `measure`, the `index`-th of six, with an axis that holds every value
/// and 0.
BoxPanel panel_of(const BoxLayout& layout, const std::vector<BoxGroup>& groups, std::size_t index,
                  std::size_t measure);

}  // namespace croon::experiments
