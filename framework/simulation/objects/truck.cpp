#include <algorithm>

#include "framework/simulation/objects/vehicle_parts.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// The dimensions of a truck.
struct TruckShape {
  Span whole_m;  ///< From its rear to its front.
  Span load_m;   ///< The load, behind the cab and a gap.
  double cab_rear_m = 0.0;
  double height_m = 3.5;
  double half_width_m = 1.25;
  double deck_m = 1.2;  ///< Height of the deck that carries the load.
  double wheel_radius_m = 0.5;
};

TruckShape draw_shape(Rng& rng) {
  TruckShape shape;
  const double length_m = rng.uniform(7.0, 16.0);
  shape.whole_m = {-0.5 * length_m, 0.5 * length_m};
  shape.cab_rear_m = shape.whole_m.to - rng.uniform(1.7, 2.3);
  const double gap_m = rng.uniform(0.3, 0.8);
  shape.load_m = {shape.whole_m.from, shape.cab_rear_m - gap_m};
  shape.height_m = rng.uniform(2.9, 4.0);
  shape.half_width_m = rng.uniform(1.15, 1.275);
  shape.wheel_radius_m = rng.uniform(0.44, 0.52);
  shape.deck_m = 2.0 * shape.wheel_radius_m + rng.uniform(0.1, 0.25);
  return shape;
}

void add_cab(Mesh& mesh, const TruckShape& shape, Rng& rng) {
  const Material coat = draw_coat(rng);
  const double roof_m = std::min(shape.height_m - 0.05, rng.uniform(2.7, 3.5));
  const double front_m = shape.whole_m.to;
  const double rear_m = shape.cab_rear_m;
  const double half_m = shape.half_width_m;
  Cabin cabin;
  cabin.belt = {0.55 * roof_m, rear_m, front_m - 0.04, half_m - 0.01};
  cabin.roof = {roof_m - 0.05, rear_m + 0.03, front_m - rng.uniform(0.15, 0.4), half_m - 0.1};
  cabin.window_top_ratio = 0.75;
  cabin.windows = {{rear_m + 0.8, front_m - 0.25}};
  cabin.has_rear_window = false;
  cabin.material = coat;
  add_cabin(mesh, cabin);
  // The engine is below the seats, between the front wheels.
  const double above_wheels_m = 2.0 * shape.wheel_radius_m + 0.05;
  add_stack(mesh, {{above_wheels_m, rear_m, front_m - 0.06, half_m}, cabin.belt}, coat);
  add_box(mesh, {rear_m, -half_m + 0.4, 0.4}, {front_m - 0.06, half_m - 0.4, above_wheels_m},
          Material::metal);
  add_box(mesh, {front_m - 0.5, -half_m, 0.35}, {front_m, half_m, above_wheels_m},
          Material::rubber);
  add_mirrors(mesh, front_m - 0.25, half_m - 0.02, 0.68 * roof_m, 0.6);
}

void add_cargo_box(Mesh& mesh, const TruckShape& shape, Rng& rng) {
  const Material wall = pick<Material>({Material::paint, Material::metal, Material::cloth}, rng);
  const auto& [rear_m, front_m] = shape.load_m;
  const double half_m = shape.half_width_m;
  add_stack(mesh,
            {{shape.deck_m, rear_m, front_m, half_m - 0.02},
             {shape.height_m - 0.08, rear_m, front_m, half_m - 0.02},
             {shape.height_m, rear_m + 0.06, front_m - 0.06, half_m - 0.08}},
            wall);
  // The rails along the floor protrude.
  for (const double side : {1.0, -1.0}) {
    const double y_m = side * (half_m - 0.05);
    add_box(mesh, {rear_m, y_m - 0.05, shape.deck_m - 0.05},
            {front_m, y_m + 0.05, shape.deck_m + 0.1}, Material::metal);
  }
}

void add_flatbed(Mesh& mesh, const TruckShape& shape, Rng& rng) {
  const auto& [rear_m, front_m] = shape.load_m;
  const double half_m = shape.half_width_m;
  const double deck_m = shape.deck_m;
  const double board_m = deck_m + rng.uniform(0.3, 0.6);
  add_box(mesh, {rear_m, -half_m, deck_m - 0.1}, {front_m, half_m, deck_m}, Material::wood);
  for (const double side : {1.0, -1.0}) {
    const double y_m = side * (half_m - 0.02);
    add_box(mesh, {rear_m, y_m - 0.02, deck_m}, {front_m, y_m + 0.02, board_m}, Material::wood);
  }
  add_box(mesh, {front_m - 0.06, -half_m, deck_m}, {front_m, half_m, deck_m + 1.2},
          Material::metal);
  double box_m = rear_m + rng.uniform(0.2, 0.8);
  while (box_m < front_m - 1.2) {
    const double length_m = std::min(rng.uniform(1.0, 2.4), front_m - 0.1 - box_m);
    const double load_half_m = rng.uniform(0.5, 0.9) * half_m;
    const double top_m = deck_m + rng.uniform(0.4, 1.5);
    const Material material =
        pick<Material>({Material::wood, Material::concrete, Material::metal}, rng);
    add_box(mesh, {box_m, -load_half_m, deck_m}, {box_m + length_m, load_half_m, top_m}, material);
    box_m += length_m + rng.uniform(0.1, 1.0);
  }
}

void add_tank(Mesh& mesh, const TruckShape& shape, Rng& rng) {
  const auto& [rear_m, front_m] = shape.load_m;
  const double top_m = std::min(shape.height_m - 0.2, shape.deck_m + 2.0);
  const double radius_m = std::min(shape.half_width_m - 0.05, 0.5 * (top_m - shape.deck_m + 0.2));
  const Vector3d rear(rear_m + 0.25, 0.0, top_m - radius_m);
  const Vector3d front(front_m - 0.25, 0.0, top_m - radius_m);
  const Material material = draw_coat(rng);
  add_cylinder(mesh, rear, front, radius_m, radius_m, 16, material);
  const Vector3d bulge(0.2, 0.0, 0.0);
  add_cylinder(mesh, front, front + bulge, radius_m, 0.7 * radius_m, 16, material);
  add_cylinder(mesh, rear, rear - bulge, radius_m, 0.7 * radius_m, 16, material);
  add_box(mesh, {rear.x(), -0.25, top_m - 0.1}, {front.x(), 0.25, top_m + 0.08}, Material::metal);
  add_box(mesh, {rear_m, -0.6, shape.deck_m - 0.1}, {front_m, 0.6, rear.z()}, Material::metal);
}

void add_chassis(Mesh& mesh, const TruckShape& shape) {
  const auto& [rear_m, front_m] = shape.whole_m;
  const double half_m = shape.half_width_m;
  add_box(mesh, {rear_m + 0.05, -0.43, shape.wheel_radius_m},
          {front_m - 0.3, 0.43, shape.deck_m - 0.05}, Material::metal);
  add_box(mesh, {rear_m, -half_m + 0.05, 0.45}, {rear_m + 0.12, half_m - 0.05, 0.6},
          Material::metal);
  const Wheels wheels = {shape.wheel_radius_m, 0.35, half_m};
  const double length_m = front_m - rear_m;
  const double pitch_m = 2.0 * shape.wheel_radius_m + 0.25;
  add_axle(mesh, front_m - 1.3, wheels);
  const int rear_axles = length_m < 9.0 ? 1 : (length_m < 12.5 ? 2 : 3);
  for (int i = 0; i < rear_axles; ++i)
    add_axle(mesh, rear_m + 0.16 * length_m + i * pitch_m, wheels);
  // Tanks or boxes between the axles, on both sides.
  for (const double side : {1.0, -1.0}) {
    const Vector3d tank(front_m - 2.6, side * (half_m - 0.4), 0.75);
    add_cylinder(mesh, tank, tank - Vector3d(1.1, 0.0, 0.0), 0.3, 0.3, 8, Material::metal);
  }
}

}  // namespace

Mesh make_truck(Rng& rng) {
  Mesh mesh;
  const TruckShape shape = draw_shape(rng);
  add_chassis(mesh, shape);
  add_cab(mesh, shape, rng);
  using AddLoad = void (*)(Mesh&, const TruckShape&, Rng&);
  // Boxes are drawn most often.
  const auto add_load = pick<AddLoad>({add_cargo_box, add_cargo_box, add_flatbed, add_tank}, rng);
  add_load(mesh, shape, rng);
  add_lights(mesh, shape.whole_m, shape.half_width_m - 0.05, 0.75);
  return mesh;
}

}  // namespace croon::simulation
