#include "experiments/report/box_layout.hpp"

#include <algorithm>

#include "framework/base/text.hpp"

namespace croon::experiments {

namespace {

// Pixels.
constexpr double kPanelTitle = 26.0;
constexpr double kAxisWidth = 58.0;
constexpr double kLeastPlotWidth = 260.0;
constexpr double kGroupGap = 18.0;
constexpr double kSensorHeight = 22.0;
constexpr double kLetterWidth = 6.2;

}  // namespace

double BoxLayout::panel_width() const { return kAxisWidth + plot_width + kMargin; }

double BoxLayout::panel_height() const {
  return kPanelTitle + kPlotHeight + label_height + kSensorHeight + kMargin;
}

double BoxLayout::width() const {
  return 2.0 * kMargin + static_cast<double>(columns) * panel_width();
}

double BoxLayout::height() const {
  const auto rows = kDofs / columns;
  return kTitleHeight + static_cast<double>(rows) * panel_height() + kMargin;
}

double BoxPanel::y(double value) const {
  return top + kPlotHeight * (axis.high - value) / (axis.high - axis.low);
}

double group_width(const BoxGroup& group) {
  return std::max(kBoxPitch * static_cast<double>(group.boxes.size()),
                  kLetterWidth * static_cast<double>(text_columns(group.sensor)));
}

BoxLayout layout_of(const std::vector<BoxGroup>& groups) {
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

BoxPanel panel_of(const BoxLayout& layout, const std::vector<BoxGroup>& groups, std::size_t index,
                  std::size_t measure) {
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
  // With two columns, rotations stand left and translations right.
  const std::size_t rows = kDofs / layout.columns;
  const std::size_t row = layout.columns == 2 ? index % rows : index / layout.columns;
  const std::size_t column = layout.columns == 2 ? index / rows : index % layout.columns;
  return {kMargin + static_cast<double>(column) * layout.panel_width() + kAxisWidth,
          kTitleHeight + static_cast<double>(row) * layout.panel_height() + kPanelTitle,
          layout.plot_width, round_axis(low, high, 5)};
}

}  // namespace croon::experiments
