#include <algorithm>
#include <array>
#include <map>

#include "experiments/report/panels.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

constexpr double kTopShare = 0.25;  // Share of points in one bin, at the top of the axis.

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

/// Draws the frame of a panel: bins on the x axis, shares of points, in multiples of `kTopShare`,
/// on the y axis.
void draw_ranges_panel(Drawing& drawing, const Plot& plot, const std::string& sensor) {
  const double text = drawing.sheet().small();
  for (const double share : {0.0, 0.05, 0.1, 0.15, 0.2, 0.25}) {
    plot.draw_y_tick(drawing, share / kTopShare, fixed_number(100.0 * share, 0), 0.7 * text);
  }
  for (std::size_t bin = 0; bin < kRangeBins; bin += 8) {
    const double range_m = range_bin_m(bin);
    plot.draw_x_tick(drawing, static_cast<double>(bin),
                     fixed_number(range_m, range_m < 0.5 ? 1 : 0), 1.4 * text);
  }
  draw_panel_texts(drawing, plot, sensor, "range, m");
}

/// The shares of a mean histogram, the sum of `count` of them divided by `kTopShare`.
std::vector<double> shown_shares(const Shares& sum, int count) {
  std::vector<double> shares;
  for (const double share : sum) shares.push_back(std::min(share / count, kTopShare) / kTopShare);
  return shares;
}

}  // namespace

Drawing ranges_chart(const std::vector<CloudDescription>& clouds, const FigureOptions& options) {
  constexpr std::size_t kMarkerEvery = 5;
  std::vector<double> centres;
  for (std::size_t bin = 0; bin < kRangeBins; ++bin) {
    centres.push_back(static_cast<double>(bin) + 0.5);
  }
  const Histograms histograms(clouds);
  const std::vector<std::string> labels = line_labels(histograms.datasets);
  auto [grid, drawing] = panel_figure(
      options.sheet, "Share of each sensor's points over the range, in %", "Mean over scenes",
      histograms.sensors.size(), is_wide(options.sheet) ? 2 : 1, 0.4, labels);
  for (std::size_t s = 0; s < histograms.sensors.size(); ++s) {
    const Plot plot = plot_of(grid, s, {0.0, kRangeBins}, {0.0, 1.0});
    draw_ranges_panel(drawing, plot, histograms.sensors[s]);
    draw_side_text(drawing, grid, s, plot, "points, %");
    for (std::size_t d = 0; d < histograms.datasets.size(); ++d) {
      const auto found = histograms.sums.find({histograms.datasets[d], histograms.sensors[s]});
      if (found == histograms.sums.end()) continue;
      draw_series(drawing, plot, centres, shown_shares(found->second.first, found->second.second),
                  d, kMarkerEvery);
    }
  }
  draw_panel_legend(drawing, grid, labels);
  return drawing;
}

}  // namespace croon::experiments
