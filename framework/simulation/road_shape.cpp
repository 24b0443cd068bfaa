#include "framework/simulation/road_shape.hpp"

#include <algorithm>
#include <cmath>

namespace croon::simulation {
namespace {

constexpr double kKerbFace_m = 0.03;   ///< Horizontal extent of a kerb's inclined face.
constexpr double kKerbStone_m = 0.16;  ///< Width of a kerb stone.
constexpr double kCornerRadius_m = 5.0;
constexpr double kLineWidth_m = 0.15;

/// Adds the grid lines for a kerb: at its foot, its top and the back of its stone; more around a
/// corner.
void add_kerb(std::vector<double>& lines, double kerb_m, double outwards, bool has_corner) {
  for (const double step_m : {0.0, kKerbFace_m, kKerbStone_m}) {
    lines.push_back(kerb_m + outwards * step_m);
  }
  if (!has_corner) return;
  constexpr double kStep_m = 0.35;
  for (double step_m = 2.0 * kStep_m; step_m <= kCornerRadius_m; step_m += kStep_m) {
    lines.push_back(kerb_m + outwards * step_m);
  }
}

constexpr double kNearStep_m = 0.75;

/// The distance from the grid line at `line_m` to the next one outwards.
double step_at(double line_m) {
  constexpr double kNear_m = 20.0;
  constexpr double kGrowth = 1.1;
  return kNearStep_m + (kGrowth - 1.0) * std::max(line_m - kNear_m, 0.0);
}

/// Ascending lines from `-extent_m` to `extent_m`: those of `required` in between, and others at a
/// distance from them.
std::vector<double> grid_lines(std::vector<double> required, double extent_m) {
  required.erase(std::remove_if(required.begin(), required.end(),
                                [&](double line_m) { return std::abs(line_m) >= extent_m; }),
                 required.end());
  std::sort(required.begin(), required.end());
  std::vector<double> lines = required;
  const auto add = [&](double line_m) {
    const auto next = std::lower_bound(required.begin(), required.end(), line_m);
    const double room_m = 0.3 * step_at(std::abs(line_m));
    if (next != required.end() && *next - line_m < room_m) return;
    if (next != required.begin() && line_m - *(next - 1) < room_m) return;
    lines.push_back(line_m);
  };
  add(0.0);
  for (double line_m = kNearStep_m; line_m < extent_m; line_m += step_at(line_m)) {
    add(line_m);
    add(-line_m);
  }
  lines.push_back(-extent_m);
  lines.push_back(extent_m);
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

}  // namespace

double RoadShape::beyond_carriageway_m(double s_m, double d_m) const {
  const double beside_m = std::abs(d_m) - half_width_m;
  if (!crossing) return beside_m;
  const double across_m = std::abs(s_m - crossing->s_m) - crossing->half_width_m;
  const double in_m = kCornerRadius_m - beside_m;
  const double into_m = kCornerRadius_m - across_m;
  if (in_m > 0.0 && into_m > 0.0 && beside_m > 0.0 && across_m > 0.0) {
    return kCornerRadius_m - std::hypot(in_m, into_m);
  }
  return std::min(beside_m, across_m);
}

double RoadShape::height_m(double s_m, double d_m) const {
  constexpr double kRunOut_m = 8.0;  // The crown flattens towards a crossing.
  double crown_here = crown;
  if (crossing) {
    const double from_m = std::abs(s_m - crossing->s_m) - crossing->half_width_m;
    crown_here *= std::clamp(from_m / kRunOut_m, 0.0, 1.0);
  }
  const double crown_m = crown_here * std::min(std::abs(d_m), half_width_m);
  const double kerb_m =
      kerb_height_m * std::clamp(beyond_carriageway_m(s_m, d_m) / kKerbFace_m, 0.0, 1.0);
  return grade * s_m + banking * d_m - crown_m + kerb_m;
}

double RoadShape::roughness_at(double s_m, double d_m) const {
  const bool is_behind = beyond_carriageway_m(s_m, d_m) > std::max(pavement_width_m, kKerbStone_m);
  return is_behind ? behind_roughness_m : roughness_m;
}

bool RoadShape::is_on_line(double s_m, double d_m) const {
  constexpr double kDash_m = 3.0;
  constexpr double kDashPeriod_m = 9.0;
  if (crossing && std::abs(s_m - crossing->s_m) < crossing->half_width_m + kCornerRadius_m) {
    return false;
  }
  const double in_period_m = s_m - kDashPeriod_m * std::floor(s_m / kDashPeriod_m);
  return std::any_of(lines.begin(), lines.end(), [&](const LaneLine& line) {
    return std::abs(d_m - line.d_m) < 0.5 * kLineWidth_m &&
           (!line.is_dashed || in_period_m < kDash_m);
  });
}

Material RoadShape::material_at(double s_m, double d_m) const {
  const double beyond_m = beyond_carriageway_m(s_m, d_m);
  if (beyond_m < 0.0) return is_on_line(s_m, d_m) ? Material::marking : Material::asphalt;
  if (kerb_height_m > 0.0 && beyond_m < kKerbStone_m) return Material::concrete;
  return beyond_m < pavement_width_m ? Material::paving : behind;
}

std::vector<double> RoadShape::grid_s_m() const {
  constexpr double kLength_m = 250.0;
  std::vector<double> required;
  if (crossing) {
    for (const double side : {-1.0, 1.0}) {
      add_kerb(required, crossing->s_m + side * crossing->half_width_m, side, true);
    }
  }
  return grid_lines(required, kLength_m);
}

std::vector<double> RoadShape::grid_d_m() const {
  constexpr double kWidth_m = 120.0;
  std::vector<double> required;
  for (const double side : {-1.0, 1.0}) {
    add_kerb(required, side * half_width_m, side, crossing.has_value());
    required.push_back(side * (half_width_m + pavement_width_m));
  }
  for (const LaneLine& line : lines) {
    required.push_back(line.d_m - 0.5 * kLineWidth_m);
    required.push_back(line.d_m + 0.5 * kLineWidth_m);
  }
  // On the inside of a curve the surface must end before the curve's centre.
  const double bend_m = 0.8 / std::max(std::abs(curvature_per_m), 1e-9);
  return grid_lines(required, std::min(kWidth_m, bend_m));
}

}  // namespace croon::simulation
