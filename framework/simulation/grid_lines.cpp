#include "framework/simulation/grid_lines.hpp"

#include <algorithm>
#include <cmath>

namespace croon::simulation {
namespace {

constexpr double kNear_m = 20.0;
constexpr double kStep_m = 0.75;
constexpr double kGrowth = 1.1;

/// The step from `place_m` outwards.
double step_at(double place_m) {
  return kStep_m + (kGrowth - 1.0) * std::max(place_m - kNear_m, 0.0);
}

}  // namespace

std::vector<double> grid_lines(std::vector<double> wanted, double extent_m) {
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(),
                              [&](double place_m) { return std::abs(place_m) >= extent_m; }),
               wanted.end());
  std::sort(wanted.begin(), wanted.end());
  std::vector<double> lines = wanted;
  const auto add = [&](double place_m) {
    const auto next = std::lower_bound(wanted.begin(), wanted.end(), place_m);
    const double room_m = 0.3 * step_at(std::abs(place_m));
    if (next != wanted.end() && *next - place_m < room_m) return;
    if (next != wanted.begin() && place_m - *(next - 1) < room_m) return;
    lines.push_back(place_m);
  };
  add(0.0);
  for (double place_m = kStep_m; place_m < extent_m; place_m += step_at(place_m)) {
    add(place_m);
    add(-place_m);
  }
  lines.push_back(-extent_m);
  lines.push_back(extent_m);
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

}  // namespace croon::simulation
