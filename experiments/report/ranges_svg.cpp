#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "experiments/report/plots.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {
namespace {

// Colours of Okabe and Ito (2008).
constexpr const char* kStyleSheet = R"css(text { font: 12px sans-serif; fill: #222; }
.title { font-size: 13px; font-weight: bold; }
.page { fill: #fff; }
.grid { stroke: #ddd; }
.c0 { stroke: #0072b2; stroke-width: 2; }
.c1 { stroke: #d55e00; stroke-width: 2; }
.c2 { stroke: #009e73; stroke-width: 2; }
.c3 { stroke: #cc79a7; stroke-width: 2; }
)css";
constexpr std::size_t kColours = 4;
constexpr double kWidth = 320.0;
constexpr double kHeight = 170.0;
constexpr double kLeft = 46.0;
constexpr double kTop = 56.0;
constexpr double kGap = 60.0;
constexpr double kMost = 0.25;  // Of the points in one bin.

using Shares = std::array<double, kRangeBins>;

/// The mean histogram of each dataset and sensor, in the order in which they come first.
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

std::string colour(std::size_t index) { return "c" + std::to_string(index % kColours); }

/// Draws the frame of the panel at (left, top) and returns its plot: bins to the right, upwards
/// shares of `kMost`.
Plot draw_panel(Svg& svg, double left, double top, const std::string& sensor) {
  const Plot plot = {left, top, kWidth, kHeight, {0.0, kRangeBins}, {0.0, 1.0}};
  svg.text(left, top - 8.0, sensor, Anchor::start, "title");
  for (const double share : {0.0, 0.05, 0.1, 0.15, 0.2, 0.25}) {
    plot.draw_y_tick(svg, share / kMost, fixed_number(100.0 * share, 0) + " %", 6.0);
  }
  for (std::size_t bin = 0; bin < kRangeBins; bin += 8) {
    const double range_m = range_bin_m(bin);
    plot.draw_x_tick(svg, static_cast<double>(bin),
                     fixed_number(range_m, range_m < 0.5 ? 1 : 0) + " m", 16.0);
  }
  return plot;
}

/// Draws a mean histogram: the sum of `count` of them.
void draw_line(Svg& svg, const Plot& plot, const Shares& sum, int count, const std::string& style) {
  const auto y = [&](std::size_t bin) { return plot.y(std::min(sum[bin] / count, kMost) / kMost); };
  for (std::size_t bin = 0; bin + 1 < kRangeBins; ++bin) {
    const double middle = static_cast<double>(bin) + 0.5;
    svg.line(plot.x(middle), y(bin), plot.x(middle + 1.0), y(bin + 1), style);
  }
}

}  // namespace

std::string ranges_svg(const std::vector<CloudDescription>& clouds) {
  const Histograms histograms(clouds);
  const double rows = std::ceil(static_cast<double>(histograms.sensors.size()) / 2.0);
  const double width = 2.0 * (kLeft + kWidth) + 40.0;
  const double height = kTop + rows * (kHeight + kGap) + 10.0;
  Svg svg(width, height, kStyleSheet);
  svg.rectangle(0.0, 0.0, width, height, "page");
  double legend = kLeft;
  for (std::size_t i = 0; i < histograms.datasets.size(); ++i) {
    svg.line(legend, 16.0, legend + 26.0, 16.0, colour(i));
    svg.text(legend + 32.0, 20.0, histograms.datasets[i], Anchor::start, "name");
    legend += 60.0 + 7.5 * static_cast<double>(text_columns(histograms.datasets[i]));
  }
  for (std::size_t s = 0; s < histograms.sensors.size(); ++s) {
    const double left = kLeft + static_cast<double>(s % 2) * (kWidth + kLeft + 20.0);
    const double top = kTop + std::floor(static_cast<double>(s) / 2.0) * (kHeight + kGap);
    const Plot plot = draw_panel(svg, left, top, histograms.sensors[s]);
    for (std::size_t d = 0; d < histograms.datasets.size(); ++d) {
      const auto found = histograms.sums.find({histograms.datasets[d], histograms.sensors[s]});
      if (found == histograms.sums.end()) continue;
      draw_line(svg, plot, found->second.first, found->second.second, colour(d));
    }
  }
  return svg.bytes();
}

}  // namespace croon::experiments
