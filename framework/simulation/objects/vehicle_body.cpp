#include "framework/simulation/objects/vehicle_parts.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;

/// Height of the line through `points` (x, z), in order of x, at `x`.
double height_on(const std::vector<Vector2d>& points, double x) {
  std::size_t i = 1;
  while (i + 1 < points.size() && points[i].x() < x) ++i;
  const Vector2d& a = points[i - 1];
  const Vector2d& b = points[i];
  return a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
}

/// The x at which the tail reaches its full height, behind the cabin.
double tail_top_m(const BodyShape& shape) {
  return std::min(-0.5 * shape.length_m + 0.08, shape.cabin.belt.rear_m - 0.01);
}

/// The upper edge of the lower body: tail, belt line, bonnet, nose.
std::vector<Vector2d> upper_edge(const BodyShape& shape) {
  const double end_m = 0.5 * shape.length_m;
  const double belt_m = shape.cabin.belt.z_m + 0.02;
  return {{-end_m, shape.tail_m - 0.12},     {tail_top_m(shape), shape.tail_m},
          {shape.cabin.belt.rear_m, belt_m}, {shape.cabin.belt.front_m, belt_m},
          {end_m - 0.15, shape.nose_m},      {end_m, shape.nose_m - 0.18}};
}

double arch_radius_m(const BodyShape& shape) { return shape.wheel_radius_m + 0.06; }

/// Height of the sills at `x`, higher at the bumpers.
double sill_m(const BodyShape& shape, double x) {
  const double to_end_m = 0.5 * shape.length_m - std::abs(x);
  return shape.clearance_m + std::max(0.0, 0.1 - to_end_m);
}

/// Height of the underside: the sills, with circular cut-outs over the wheels.
double underside_m(const BodyShape& shape, double x) {
  double height_m = sill_m(shape, x);
  for (const double axle_m : {shape.front_axle_m, shape.rear_axle_m}) {
    const double off_m = std::abs(x - axle_m);
    const double radius_m = arch_radius_m(shape);
    if (off_m >= radius_m) continue;
    const double arch_m = std::sqrt(radius_m * radius_m - off_m * off_m);
    height_m = std::max(height_m, shape.wheel_radius_m + arch_m);
  }
  return height_m;
}

/// Half the width at `x`, which decreases towards both ends, more so at the front.
double half_width_m(const BodyShape& shape, double x) {
  const double beyond_ratio = std::max(0.0, (std::abs(x) - 0.5 * shape.length_m) / 0.55 + 1.0);
  const double rounding_ratio = x > 0.0 ? 0.16 : 0.06;
  return 0.5 * shape.width_m * (1.0 - rounding_ratio * beyond_ratio * beyond_ratio);
}

/// The x at which the outline of the body bends, ascending.
std::vector<double> stations(const BodyShape& shape) {
  const double end_m = 0.5 * shape.length_m;
  std::vector<double> stations_m = {-end_m,
                                    tail_top_m(shape),
                                    -end_m + 0.3,
                                    end_m - 0.3,
                                    end_m - 0.15,
                                    end_m,
                                    shape.cabin.belt.rear_m,
                                    shape.cabin.belt.front_m};
  for (const double axle_m : {shape.front_axle_m, shape.rear_axle_m}) {
    for (const double angle_deg : {1.0, 25.0, 60.0, 90.0, 120.0, 155.0, 179.0}) {
      stations_m.push_back(axle_m + arch_radius_m(shape) * std::cos(rad_from_deg(angle_deg)));
    }
  }
  std::sort(stations_m.begin(), stations_m.end());
  const auto is_same = [](double a, double b) { return b - a < 0.005; };
  stations_m.erase(std::unique(stations_m.begin(), stations_m.end(), is_same), stations_m.end());
  return stations_m;
}

/// The outline across the body at `x`, widest at the middle of its height. A wheel arch changes the
/// lower part only.
Ring section(const BodyShape& shape, double x) {
  const double low_m = underside_m(shape, x);
  const double high_m = height_on(upper_edge(shape), x);
  const double half_m = half_width_m(shape, x);
  const auto side_m = [&](double ratio) {
    const double whole_m = sill_m(shape, x) + ratio * (high_m - sill_m(shape, x));
    return std::max(whole_m, low_m + 0.5 * ratio * (high_m - low_m));
  };
  const std::vector<Vector2d> left = {{0.96 * half_m, low_m},
                                      {half_m, side_m(0.45)},
                                      {0.98 * half_m, side_m(0.8)},
                                      {0.92 * half_m, high_m}};
  Ring ring;
  for (const Vector2d& yz : left) ring.emplace_back(x, yz.x(), yz.y());
  for (auto yz = left.rbegin(); yz != left.rend(); ++yz) ring.emplace_back(x, -yz->x(), yz->y());
  return ring;
}

}  // namespace

void add_body(Mesh& mesh, const BodyShape& shape) {
  std::vector<Ring> rings;
  for (const double x : stations(shape)) rings.push_back(section(shape, x));
  add_loft(mesh, rings, shape.cabin.material);
  add_cabin(mesh, shape.cabin);

  const double half_m = 0.5 * shape.width_m;
  const Wheels wheels = {shape.wheel_radius_m, 0.21, half_m - 0.02};
  add_axle(mesh, shape.front_axle_m, wheels);
  add_axle(mesh, shape.rear_axle_m, wheels);
  const double end_m = 0.5 * shape.length_m;
  // Engine, floor and boot, which block the view through the arches.
  add_box(mesh, {-end_m + 0.3, -half_m + 0.24, shape.clearance_m},
          {end_m - 0.3, half_m - 0.24, shape.nose_m - 0.1}, Material::rubber);
  add_mirrors(mesh, shape.cabin.belt.front_m - 0.35, 0.88 * half_m, shape.cabin.belt.z_m + 0.09,
              0.16);
  add_lights(mesh, {-end_m, end_m}, 0.8 * half_m, shape.nose_m - 0.2);
}

}  // namespace croon::simulation
