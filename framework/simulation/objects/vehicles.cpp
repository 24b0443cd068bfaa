#include "framework/simulation/objects/vehicle_parts.hpp"

#include <algorithm>
#include <array>

#include "framework/simulation/objects/objects.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// Adds the part `span` of one side between the levels `low` and `high`; `span` is in x at the
/// lower level, with the same share of the length at the upper one.
void add_panel(Mesh& mesh, const Level& low, const Level& high, const Span& span, double side,
               Material material) {
  const auto corner = [&](const Level& level, double belt_x_m) {
    const double ratio = (belt_x_m - low.rear_m) / (low.front_m - low.rear_m);
    const double x = level.rear_m + ratio * (level.front_m - level.rear_m);
    return Vector3d(x, side * level.half_width_m, level.z_m);
  };
  mesh.add_quad(corner(low, span.from), corner(low, span.to), corner(high, span.to),
                corner(high, span.from), material);
}

/// Adds the pane across the body between `low` and `high`, at the edge `x`.
void add_pane(Mesh& mesh, const Level& low, const Level& high, double Level::*x,
              Material material) {
  mesh.add_quad({low.*x, -low.half_width_m, low.z_m}, {low.*x, low.half_width_m, low.z_m},
                {high.*x, high.half_width_m, high.z_m}, {high.*x, -high.half_width_m, high.z_m},
                material);
}

}  // namespace

void add_axle(Mesh& mesh, double x_m, const Wheels& wheels) {
  const auto& [radius_m, width_m, half_track_m] = wheels;
  const double hub_m = 0.6 * radius_m;
  for (const double side : {1.0, -1.0}) {
    const Vector3d outside(x_m, side * (half_track_m - 0.012), radius_m);
    const Vector3d inside(x_m, side * (half_track_m - width_m), radius_m);
    const Vector3d cap(x_m, side * half_track_m, radius_m);
    // Of the twelve corners, the lowest is on the ground.
    add_cylinder(mesh, inside, outside, radius_m, radius_m, 12, Material::rubber);
    add_cylinder(mesh, outside, cap, hub_m, 0.9 * hub_m, 6, Material::metal);
  }
  const Vector3d reach(0.0, half_track_m - width_m, 0.0);
  const Vector3d middle(x_m, 0.0, radius_m);
  add_cylinder(mesh, middle - reach, middle + reach, 0.07, 0.07, 4, Material::metal);
}

void add_cabin(Mesh& mesh, const Cabin& cabin) {
  const Level& belt = cabin.belt;
  const Level& roof = cabin.roof;
  const Level eaves = between(belt, roof, cabin.window_top_ratio);
  for (const double side : {1.0, -1.0}) {
    for (const Span& window : cabin.windows) {
      add_panel(mesh, belt, eaves, window, side, Material::glass);
    }
    for (const Span& pillar : without({belt.rear_m, belt.front_m}, cabin.windows)) {
      add_panel(mesh, belt, eaves, pillar, side, cabin.material);
    }
  }
  add_pane(mesh, belt, eaves, &Level::front_m, Material::glass);
  add_pane(mesh, belt, eaves, &Level::rear_m,
           cabin.has_rear_window ? Material::glass : cabin.material);
  const double inset_m = 0.15 * roof.half_width_m;
  const Level crown = {roof.z_m + 0.3 * inset_m, roof.rear_m + inset_m, roof.front_m - inset_m,
                       roof.half_width_m - inset_m};
  add_stack(mesh, {eaves, roof, crown}, cabin.material);
}

void add_mirrors(Mesh& mesh, double x_m, double half_width_m, double height_m, double size_m) {
  for (const double side : {1.0, -1.0}) {
    const double inside_m = side * half_width_m;
    const double outside_m = side * (half_width_m + 0.2);
    add_box(mesh, {x_m - 0.05, std::min(inside_m, outside_m), height_m - 0.5 * size_m},
            {x_m + 0.05, std::max(inside_m, outside_m), height_m + 0.5 * size_m}, Material::rubber);
  }
}

void add_lights(Mesh& mesh, const Span& ends, double half_width_m, double height_m) {
  constexpr double kDepth_m = 0.12;  // The ends of a body are rounded.
  constexpr double kOut_m = 0.012;
  for (const double front_m : {ends.from + kDepth_m - kOut_m, ends.to + kOut_m}) {
    for (const double side : {1.0, -1.0}) {
      add_plate(mesh, {front_m, side * (half_width_m - 0.15), height_m}, rectangle(0.3, 0.14),
                kDepth_m, Material::glass);
    }
    add_plate(mesh, {front_m, 0.0, height_m - 0.2}, rectangle(0.52, 0.11), kDepth_m,
              Material::sign);
  }
}

Material draw_coat(Rng& rng) {
  return pick<Material>({Material::white_paint, Material::black_paint, Material::metal,
                         Material::blue_paint, Material::paint},
                        rng);
}

Vehicle make_vehicle(VehicleType type, Rng& rng) {
  Vehicle vehicle;
  // In the order of VehicleType.
  constexpr std::array<Mesh (*)(Rng&), 4> kMakers = {make_car, make_van, make_truck, make_bus};
  vehicle.mesh = kMakers[static_cast<std::size_t>(type)](rng);
  Eigen::Vector3f reach = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& vertex : vehicle.mesh.vertices) {
    reach = reach.cwiseMax(vertex.cwiseAbs());
  }
  vehicle.size_m = reach.cast<double>().cwiseProduct(Eigen::Vector3d(2.0, 2.0, 1.0));
  return vehicle;
}

}  // namespace croon::simulation
