#include <algorithm>
#include <cmath>

#include "framework/simulation/objects/vehicle_parts.hpp"

namespace croon::simulation {
namespace {

constexpr double kRecess_m = 0.02;  ///< Depth of the panes behind the panels.
constexpr double kFloor_m = 0.32;
constexpr double kSill_m = 1.05;

/// The dimensions of a bus.
struct BusShape {
  Span whole_m;
  double half_width_m = 1.275;
  double roof_m = 2.9;  ///< Height of the roof's edge.
  double window_top_m = 2.4;
  double wheel_radius_m = 0.48;
  std::vector<double> axles_m;  ///< x of each axle, from the rear.
  std::vector<Span> doors_m;    ///< On the right side, from the rear.
  Material coat = Material::paint;
};

BusShape draw_shape(Rng& rng) {
  BusShape shape;
  const double length_m = rng.uniform(11.0, 18.0);
  const double end_m = 0.5 * length_m;
  shape.whole_m = {-end_m, end_m};
  shape.half_width_m = rng.uniform(1.24, 1.29);
  shape.roof_m = rng.uniform(2.8, 3.0);
  shape.window_top_m = shape.roof_m - rng.uniform(0.35, 0.6);
  shape.wheel_radius_m = rng.uniform(0.46, 0.5);
  const double rear_axle_m = -end_m + rng.uniform(2.8, 3.4);
  shape.axles_m = {rear_axle_m, end_m - 2.7};
  if (length_m > 14.0) shape.axles_m.insert(shape.axles_m.begin() + 1, rear_axle_m + 1.35);
  const double door_m = rng.uniform(1.1, 1.3);
  const double middle_m = rng.uniform(-0.05, 0.05) * length_m;
  shape.doors_m = {{middle_m, middle_m + door_m}, {end_m - 0.4 - door_m, end_m - 0.4}};
  shape.coat = draw_coat(rng);
  return shape;
}

/// Adds the panels of one side between two heights, with holes.
void add_panels(Mesh& mesh, const BusShape& shape, double side, const Span& height_m,
                const std::vector<Span>& holes) {
  const double inside_m = side * (shape.half_width_m - kRecess_m);
  const double outside_m = side * shape.half_width_m;
  for (const Span& panel : without(shape.whole_m, holes)) {
    add_box(mesh, {panel.from, std::min(inside_m, outside_m), height_m.from},
            {panel.to, std::max(inside_m, outside_m), height_m.to}, shape.coat);
  }
}

std::vector<Span> sorted(std::vector<Span> spans) {
  std::sort(spans.begin(), spans.end(),
            [](const Span& a, const Span& b) { return a.from < b.from; });
  return spans;
}

/// The panes of one side, of at least 2.4 m with posts between them, and the doors.
std::vector<Span> windows_of(const BusShape& shape, const std::vector<Span>& doors_m) {
  std::vector<Span> windows;
  for (const Span& wall : without({shape.whole_m.from + 0.3, shape.whole_m.to - 0.15}, doors_m)) {
    const double length_m = wall.length();
    const int count = std::max(1, static_cast<int>(length_m / 2.4));
    for (int i = 0; i < count; ++i) {
      windows.push_back(
          {wall.from + length_m * i / count + 0.05, wall.from + length_m * (i + 1) / count - 0.05});
    }
  }
  windows.insert(windows.end(), doors_m.begin(), doors_m.end());
  return sorted(windows);
}

void add_side(Mesh& mesh, const BusShape& shape, double side, const std::vector<Span>& doors_m) {
  std::vector<Span> skirt_holes = doors_m;
  for (const double axle_m : shape.axles_m) {
    const double reach_m = shape.wheel_radius_m + 0.08;
    skirt_holes.push_back({axle_m - reach_m, axle_m + reach_m});
  }
  add_panels(mesh, shape, side, {kFloor_m, kSill_m}, sorted(skirt_holes));
  add_panels(mesh, shape, side, {kSill_m, kSill_m + 0.1}, doors_m);
  add_panels(mesh, shape, side, {kSill_m + 0.1, shape.window_top_m}, windows_of(shape, doors_m));
  add_panels(mesh, shape, side, {shape.window_top_m, shape.roof_m}, {});
}

/// Adds doors with two leaves of glass each, whose frames meet in the middle.
void add_doors(Mesh& mesh, const BusShape& shape) {
  const double y_m = -shape.half_width_m;
  for (const Span& door : shape.doors_m) {
    const double middle_m = door.middle();
    add_box(mesh, {middle_m - 0.04, y_m, kFloor_m},
            {middle_m + 0.04, y_m + kRecess_m, shape.window_top_m}, Material::rubber);
    add_box(mesh, {door.from, y_m + 0.5 * kRecess_m, kFloor_m},
            {door.to, y_m + 0.9 * kRecess_m, kSill_m + 0.1}, Material::glass);
  }
}

/// Adds the panels around the pane at one end: below it, above it and at its sides.
void add_end(Mesh& mesh, const BusShape& shape, double outside_m, double pane_from_m) {
  const double inside_m = outside_m - std::copysign(kRecess_m, outside_m);
  const double low_x = std::min(inside_m, outside_m);
  const double high_x = std::max(inside_m, outside_m);
  const double half_m = shape.half_width_m;
  add_box(mesh, {low_x, -half_m, kFloor_m}, {high_x, half_m, pane_from_m}, shape.coat);
  add_box(mesh, {low_x, -half_m, shape.window_top_m + 0.1}, {high_x, half_m, shape.roof_m},
          shape.coat);
  for (const double y_m : {-half_m, half_m - 0.12}) {
    add_box(mesh, {low_x, y_m, pane_from_m}, {high_x, y_m + 0.12, shape.window_top_m + 0.1},
            shape.coat);
  }
}

/// Adds the roof and the body behind the panels.
void add_core(Mesh& mesh, const BusShape& shape, Rng& rng) {
  const double rear_m = shape.whole_m.from + kRecess_m;
  const double front_m = shape.whole_m.to - kRecess_m;
  const double half_m = shape.half_width_m - kRecess_m;
  add_box(mesh, {rear_m, -half_m, kFloor_m}, {front_m, half_m, kSill_m}, Material::rubber);
  add_box(mesh, {rear_m, -half_m, kSill_m}, {front_m, half_m, shape.roof_m}, Material::glass);
  const auto roof = [&](double above_m, double inset_m) {
    return Level{shape.roof_m + above_m, shape.whole_m.from + inset_m, shape.whole_m.to - inset_m,
                 shape.half_width_m - inset_m};
  };
  add_stack(mesh, {roof(-0.02, 0.0), roof(0.02, 0.04), roof(0.09, 0.2)}, shape.coat);
  const double unit_m = rng.uniform(-0.3, 0.2) * (front_m - rear_m);
  add_stack(mesh,
            {{shape.roof_m + 0.08, unit_m - 1.2, unit_m + 1.2, 0.9},
             {shape.roof_m + 0.25, unit_m - 1.05, unit_m + 1.05, 0.8}},
            Material::metal);
}

}  // namespace

Mesh make_bus(Rng& rng) {
  Mesh mesh;
  const BusShape shape = draw_shape(rng);
  add_core(mesh, shape, rng);
  add_side(mesh, shape, 1.0, {});
  add_side(mesh, shape, -1.0, shape.doors_m);
  add_doors(mesh, shape);
  add_end(mesh, shape, shape.whole_m.to, kSill_m);
  add_end(mesh, shape, shape.whole_m.from, 1.5);
  for (const double axle_m : shape.axles_m) {
    add_axle(mesh, axle_m, {shape.wheel_radius_m, 0.3, shape.half_width_m});
  }
  add_mirrors(mesh, shape.whole_m.to - 0.15, shape.half_width_m - 0.02, 2.1, 0.4);
  add_lights(mesh, shape.whole_m, shape.half_width_m - 0.1, 0.7);
  return mesh;
}

}  // namespace croon::simulation
