#include <algorithm>

#include "experiments/report/plots.hpp"
#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"
#include "framework/picture/svg.hpp"

namespace croon::experiments {
namespace {

constexpr double kWidth = 560.0;  // Pixels, all of them.
constexpr double kHeight = 300.0;
constexpr double kLeft = 56.0;
constexpr double kTop = 60.0;
constexpr double kBelow = 50.0;
constexpr double kLegendLine = 20.0;
constexpr double kLegendWidth = 250.0;

using Corner = std::array<double, 2>;

void draw_frame(Svg& svg, const Plot& plot, const Axis& sizes, const Sweep& sweep) {
  for (const double ratio : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    plot.draw_y_tick(svg, ratio, fixed_number(100.0 * ratio, 0), 8.0,
                     ratio == 0.0 ? "zero" : "grid");
  }
  for (const double size : sizes.ticks) {
    plot.draw_x_tick(svg, size, fixed_number(size, sizes.decimals), 18.0);
  }
  const std::string what = sweep.of == SweepOf::rotation ? "rotation" : "translation";
  svg.text(kLeft + kWidth / 2.0, kTop + kHeight + 38.0,
           what + " of the start from its centre, " + size_unit(sweep), Anchor::middle, "small");
}

void draw_row(Svg& svg, const Plot& plot, const Sweep& sweep, const BasinRow& row,
              const std::string& colour) {
  std::vector<Corner> upper, lower, curve;
  for (std::size_t level = 0; level < row.levels.size(); ++level) {
    const Share& share = row.levels[level];
    if (share.trials == 0) continue;
    const double x = plot.x(level_size(sweep, static_cast<int>(level)));
    if (share.interval) {
      upper.push_back({x, plot.y(share.interval->high)});
      lower.push_back({x, plot.y(share.interval->low)});
    }
    curve.push_back({x, plot.y(share.ratio)});
  }
  upper.insert(upper.end(), lower.rbegin(), lower.rend());
  if (!upper.empty()) svg.area(upper, colour + " band");
  for (std::size_t i = 0; i < curve.size(); ++i) {
    svg.dot(curve[i][0], curve[i][1], 3.0, colour);
    if (i > 0) {
      svg.line(curve[i - 1][0], curve[i - 1][1], curve[i][0], curve[i][1], colour + " curve");
    }
  }
}

void draw_legend(Svg& svg, std::size_t index, const std::string& variant,
                 const std::string& colour) {
  const double left = kLeft + kWidth + 24.0;
  const double y = kTop + 8.0 + kLegendLine * static_cast<double>(index);
  constexpr std::size_t kColumns = 30;
  svg.line(left, y, left + 24.0, y, colour + " curve");
  svg.text(left + 32.0, y + 4.0, cut_in_the_middle(variant, kColumns), Anchor::start, "name");
}

}  // namespace

std::string basin_svg(const Basin& basin) {
  const Axis sizes = round_axis(basin.sweep.first, basin.sweep.last, 9);
  const Plot plot = {kLeft, kTop, kWidth, kHeight, {sizes.low, sizes.high}, {0.0, 1.0}};
  const auto rows =
      static_cast<double>(std::count_if(basin.rows.begin(), basin.rows.end(),
                                        [](const BasinRow& row) { return row.sensor.empty(); }));
  const double width = kLeft + kWidth + 24.0 + kLegendWidth;
  const double height = kTop + std::max(kHeight, kLegendLine * rows) + kBelow;
  Svg svg(width, height, kChartStyle);
  svg.rectangle(0.0, 0.0, width, height, "page");
  svg.text(kLeft, 24.0, "Success in % over the size of the start's perturbation", Anchor::start,
           "title");
  svg.text(kLeft, 42.0,
           "All sensors and scenes together; the band is the 95 % interval, none for fewer than " +
               std::to_string(kLeastScenes) + " scenes",
           Anchor::start, "small");
  draw_frame(svg, plot, sizes, basin.sweep);
  std::size_t index = 0;
  for (const BasinRow& row : basin.rows) {
    if (!row.sensor.empty()) continue;
    const std::string colour = "c" + std::to_string(index % kChartColours);
    draw_row(svg, plot, basin.sweep, row, colour);
    draw_legend(svg, index++, row.variant, colour);
  }
  return svg.bytes();
}

}  // namespace croon::experiments
