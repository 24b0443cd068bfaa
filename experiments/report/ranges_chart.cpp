#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "experiments/report/plots.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {
namespace {

constexpr double kTopShare = 0.25;  // Share of points in one bin, at the top of the axis.

/// The layout of the panels, in units of the sheet.
struct RangesLayout {
  std::size_t columns;
  double left, top, gap, plot_width, plot_height, panel_width, width, height;
};

using Shares = std::array<double, kRangeBins>;

/// The mean histogram of each dataset and sensor, in order of first appearance.
struct Histograms {
  std::vector<std::string> datasets, sensors;
  std::map<std::pair<std::string, std::string>, std::pair<Shares, int>> sums;

  explicit Histograms(const std::vector<CloudDescription>& clouds) {
    const auto note = [](std::vector<std::string>& names, const std::string& name) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    for (const CloudDescription& cloud : clouds) {
      note(datasets, cloud.dataset);
      note(sensors, cloud.sensor);
      auto& [sum, count] = sums[{cloud.dataset, cloud.sensor}];
      for (std::size_t bin = 0; bin < kRangeBins; ++bin) sum[bin] += cloud.range_shares[bin];
      ++count;
    }
  }
};

RangesLayout layout_of(const Sheet& sheet, std::size_t sensors) {
  RangesLayout layout{2, 46.0, 56.0, 60.0, 320.0, 170.0, 386.0, 772.0, 0.0};
  if (sheet.width > 0.0) {
    layout.columns = sheet.width > 1.5 * kOneColumn.width ? 2 : 1;
    layout.left = 4.0 * sheet.small();
    layout.top = 3.6 * sheet.small();
    layout.gap = 3.4 * sheet.small();
    layout.width = sheet.width;
    layout.panel_width = sheet.width / static_cast<double>(layout.columns);
    layout.plot_width = layout.panel_width - layout.left - 1.5 * sheet.small();
    layout.plot_height = 75.0;
  }
  const auto rows = std::ceil(static_cast<double>(sensors) / static_cast<double>(layout.columns));
  layout.height = layout.top + rows * (layout.plot_height + layout.gap);
  return layout;
}

/// Draws the frame of the `index`-th panel and returns its plot: bins on the x axis, shares of
/// points, in multiples of `kTopShare`, on the y axis.
Plot draw_panel(Drawing& drawing, const RangesLayout& layout, std::size_t index,
                const std::string& sensor) {
  const double text = drawing.sheet().small();
  const auto [row, column] = position_in_grid(index, layout.columns);
  const double left = layout.left + column * layout.panel_width;
  const double top = layout.top + row * (layout.plot_height + layout.gap);
  const Plot plot = {left,      top, layout.plot_width, layout.plot_height, {0.0, kRangeBins},
                     {0.0, 1.0}};
  drawing.text(left, top - 0.6 * text, sensor, Anchor::start, "title");
  for (const double share : {0.0, 0.05, 0.1, 0.15, 0.2, 0.25}) {
    plot.draw_y_tick(drawing, share / kTopShare, fixed_number(100.0 * share, 0) + " %", 0.5 * text);
  }
  for (std::size_t bin = 0; bin < kRangeBins; bin += 8) {
    const double range_m = range_bin_m(bin);
    plot.draw_x_tick(drawing, static_cast<double>(bin),
                     fixed_number(range_m, range_m < 0.5 ? 1 : 0) + " m", 1.4 * text);
  }
  return plot;
}

/// Draws a mean histogram from the sum of `count` of them. Series have markers at different bins.
void draw_line(Drawing& drawing, const Plot& plot, const Shares& sum, int count,
               std::size_t series) {
  constexpr std::size_t kMarkerEvery = 5;
  std::vector<Corner> curve;
  for (std::size_t bin = 0; bin < kRangeBins; ++bin) {
    curve.push_back({plot.x(static_cast<double>(bin) + 0.5),
                     plot.y(std::min(sum[bin] / count, kTopShare) / kTopShare)});
  }
  drawing.polyline(curve, "curve " + series_style(series));
  for (std::size_t bin = series % kMarkerEvery; bin < kRangeBins; bin += kMarkerEvery) {
    draw_marker(drawing, curve[bin][0], curve[bin][1], 0.25 * drawing.sheet().small(), series);
  }
}

void draw_legend(Drawing& drawing, const RangesLayout& layout,
                 const std::vector<std::string>& names) {
  const double text = drawing.sheet().small();
  double left = layout.left;
  for (std::size_t i = 0; i < names.size(); ++i) {
    draw_legend_entry(drawing, left, 1.1 * text, i, names[i]);
    left += legend_line(drawing.sheet()) + text_width(names[i], text) + 2.0 * text;
  }
}

}  // namespace

Drawing ranges_chart(const std::vector<CloudDescription>& clouds, const FigureOptions& options) {
  const Histograms histograms(clouds);
  const RangesLayout layout = layout_of(options.sheet, histograms.sensors.size());
  Drawing drawing(layout.width, layout.height, options.sheet);
  drawing.describe("Share of each sensor's points over the range, mean over scenes.");
  drawing.rectangle(0.0, 0.0, layout.width, layout.height, "page");
  constexpr std::size_t kLegendColumns = 30;
  draw_legend(drawing, layout, distinct_labels(histograms.datasets, kLegendColumns));
  for (std::size_t s = 0; s < histograms.sensors.size(); ++s) {
    const Plot plot = draw_panel(drawing, layout, s, histograms.sensors[s]);
    for (std::size_t d = 0; d < histograms.datasets.size(); ++d) {
      const auto found = histograms.sums.find({histograms.datasets[d], histograms.sensors[s]});
      if (found == histograms.sums.end()) continue;
      draw_line(drawing, plot, found->second.first, found->second.second, d);
    }
  }
  return drawing;
}

}  // namespace croon::experiments
