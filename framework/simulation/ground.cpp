#include "framework/simulation/ground.hpp"

#include <algorithm>
#include <cmath>

#include "framework/simulation/grid_lines.hpp"
#include "framework/simulation/surface_noise.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kLength_m = 250.0;
constexpr double kWidth_m = 120.0;
constexpr double kKerbFace_m = 0.03;   ///< How far a kerb's face leans.
constexpr double kKerbStone_m = 0.16;  ///< How wide its stone is.
constexpr double kCornerRadius_m = 5.0;
constexpr double kLineWidth_m = 0.15;
constexpr double kDash_m = 3.0;
constexpr double kDashPeriod_m = 9.0;

/// How far beyond the carriageways a place lies; negative on them. The corner between two kerbs is
/// round.
double beyond_carriageway_m(const RoadShape& shape, double s_m, double d_m) {
  const double beside_m = std::abs(d_m) - shape.half_width_m;
  if (!shape.crossing) return beside_m;
  const double across_m = std::abs(s_m - shape.crossing->s_m) - shape.crossing->half_width_m;
  const double in_m = kCornerRadius_m - beside_m;
  const double into_m = kCornerRadius_m - across_m;
  if (in_m > 0.0 && into_m > 0.0 && beside_m > 0.0 && across_m > 0.0) {
    return kCornerRadius_m - std::hypot(in_m, into_m);
  }
  return std::min(beside_m, across_m);
}

/// The crown, which runs out towards a crossing.
double crown_at(const RoadShape& shape, double s_m) {
  constexpr double kRunOut_m = 8.0;
  if (!shape.crossing) return shape.crown;
  const double from_m = std::abs(s_m - shape.crossing->s_m) - shape.crossing->half_width_m;
  return shape.crown * std::clamp(from_m / kRunOut_m, 0.0, 1.0);
}

bool is_on_line(const RoadShape& shape, double s_m, double d_m) {
  if (shape.crossing &&
      std::abs(s_m - shape.crossing->s_m) < shape.crossing->half_width_m + kCornerRadius_m) {
    return false;
  }
  const double in_period_m = s_m - kDashPeriod_m * std::floor(s_m / kDashPeriod_m);
  return std::any_of(shape.lines.begin(), shape.lines.end(), [&](const LaneLine& line) {
    return std::abs(d_m - line.d_m) < 0.5 * kLineWidth_m &&
           (!line.is_dashed || in_period_m < kDash_m);
  });
}

Material material_at(const RoadShape& shape, double s_m, double d_m) {
  const double beyond_m = beyond_carriageway_m(shape, s_m, d_m);
  if (beyond_m < 0.0) return is_on_line(shape, s_m, d_m) ? Material::marking : Material::asphalt;
  if (shape.kerb_height_m > 0.0 && beyond_m < kKerbStone_m) return Material::concrete;
  return beyond_m < shape.pavement_width_m ? Material::paving : shape.behind;
}

/// Where a kerb needs lines of the grid: its foot, its top and the back of its stone; around a
/// corner many.
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

std::vector<double> lines_across(const RoadShape& shape) {
  std::vector<double> lines;
  for (const double side : {-1.0, 1.0}) {
    add_kerb(lines, side * shape.half_width_m, side, shape.crossing.has_value());
    lines.push_back(side * (shape.half_width_m + shape.pavement_width_m));
  }
  for (const LaneLine& line : shape.lines) {
    lines.push_back(line.d_m - 0.5 * kLineWidth_m);
    lines.push_back(line.d_m + 0.5 * kLineWidth_m);
  }
  // Inside of a curve the surface must end before the curve's centre.
  const double bend_m = 0.8 / std::max(std::abs(shape.curvature_per_m), 1e-9);
  return grid_lines(lines, std::min(kWidth_m, bend_m));
}

std::vector<double> lines_along(const RoadShape& shape) {
  std::vector<double> lines;
  if (shape.crossing) {
    for (const double side : {-1.0, 1.0}) {
      add_kerb(lines, shape.crossing->s_m + side * shape.crossing->half_width_m, side, true);
    }
  }
  return grid_lines(lines, kLength_m);
}

}  // namespace

Ground::Ground(const RoadShape& shape, const StreamKey& key) : shape_(shape), key_(key) {}

double Ground::height_m(double s_m, double d_m) const {
  const double beyond_m = beyond_carriageway_m(shape_, s_m, d_m);
  const double crown_m = crown_at(shape_, s_m) * std::min(std::abs(d_m), shape_.half_width_m);
  const double kerb_m = shape_.kerb_height_m * std::clamp(beyond_m / kKerbFace_m, 0.0, 1.0);
  return shape_.grade * s_m + shape_.banking * d_m - crown_m + kerb_m;
}

double Ground::roughness_at(double s_m, double d_m) const {
  constexpr double kLong_m = 6.0;
  constexpr double kShort_m = 1.5;
  const bool is_behind =
      beyond_carriageway_m(shape_, s_m, d_m) > std::max(shape_.pavement_width_m, kKerbStone_m);
  const double std_m = is_behind ? shape_.behind_roughness_m : shape_.roughness_m;
  return std_m * (0.8 * surface_noise(key_.with("long"), s_m, d_m, kLong_m) +
                  0.6 * surface_noise(key_.with("short"), s_m, d_m, kShort_m));
}

double Ground::heading_rad(double s_m) const { return shape_.curvature_per_m * s_m; }

Vector3d Ground::point(double s_m, double d_m, double above_m) const {
  const double turn_rad = heading_rad(s_m);
  const double half_rad = 0.5 * turn_rad;
  // The centre line is an arc of length s: its chord is s sin(half) / half long, half way turned.
  const double chord_m = std::abs(half_rad) < 1e-9 ? s_m : s_m * std::sin(half_rad) / half_rad;
  return {chord_m * std::cos(half_rad) - d_m * std::sin(turn_rad),
          chord_m * std::sin(half_rad) + d_m * std::cos(turn_rad),
          height_m(s_m, d_m) + roughness_at(s_m, d_m) + above_m};
}

RigidTransform Ground::upright(double s_m, double d_m, double yaw_rad) const {
  return {rotation_from_rpy({0.0, 0.0, heading_rad(s_m) + yaw_rad}), point(s_m, d_m)};
}

RigidTransform Ground::on_slope(double s_m, double d_m, double yaw_rad) const {
  // A wheelbase and a track: where the wheels of a car stand.
  constexpr double kHalfBase_m = 1.3;
  constexpr double kHalfTrack_m = 0.75;
  const double cosine = std::cos(yaw_rad);
  const double sine = std::sin(yaw_rad);
  const Vector3d front = point(s_m + kHalfBase_m * cosine, d_m + kHalfBase_m * sine);
  const Vector3d rear = point(s_m - kHalfBase_m * cosine, d_m - kHalfBase_m * sine);
  const Vector3d left = point(s_m - kHalfTrack_m * sine, d_m + kHalfTrack_m * cosine);
  const Vector3d right = point(s_m + kHalfTrack_m * sine, d_m - kHalfTrack_m * cosine);
  RigidTransform pose;
  pose.rotation.col(0) = (front - rear).normalized();
  pose.rotation.col(2) = pose.rotation.col(0).cross(left - right).normalized();
  pose.rotation.col(1) = pose.rotation.col(2).cross(pose.rotation.col(0));
  pose.translation = 0.25 * (front + rear + left + right);
  return pose;
}

void Ground::add_to(Mesh& mesh) const {
  const std::vector<double> along = lines_along(shape_);
  const std::vector<double> across = lines_across(shape_);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const double s_m : along) {
    for (const double d_m : across) mesh.add_vertex(point(s_m, d_m));
  }
  const auto row = static_cast<std::uint32_t>(across.size());
  for (std::uint32_t i = 0; i + 1 < along.size(); ++i) {
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t corner = first + i * row + j;
      mesh.add_quad(
          corner, corner + row, corner + row + 1, corner + 1,
          material_at(shape_, 0.5 * (along[i] + along[i + 1]), 0.5 * (across[j] + across[j + 1])));
    }
  }
}

}  // namespace croon::simulation
