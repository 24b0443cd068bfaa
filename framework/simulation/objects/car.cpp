#include "framework/simulation/objects/vehicle_parts.hpp"

namespace croon::simulation {
namespace {

/// The distributions of a type of car or van, by default a hatchback. Ratios in z refer to the
/// height; ratios in x refer to the length, from the car's middle forward.
struct CarType {
  Span length_m = {3.6, 4.3};
  Span width_m = {1.66, 1.8};
  Span height_m = {1.42, 1.56};
  Span clearance_m = {0.15, 0.19};
  Span wheel_radius_m = {0.29, 0.32};
  Span roof_width_ratio = {0.66, 0.74};  ///< Width of the roof relative to the car's.
  double belt_z_ratio = 0.63;            ///< The belt line.
  double nose_z_ratio = 0.5;             ///< The bonnet's front edge.
  Span belt_x_ratio = {-0.465, 0.27};    ///< Rear and front end of the cabin at the belt line.
  Span roof_x_ratio = {-0.39, 0.11};     ///< The same at the roof.
  /// On each side, from the belt's rear end (0) to its front end (1).
  std::vector<Span> window_ratios = {{0.12, 0.47}, {0.5, 0.86}};
  double window_top_ratio = 0.88;  ///< As in Cabin.
  bool has_rear_window = true;
};

CarType saloon() {
  CarType type;
  type.length_m = {4.3, 5.0};
  type.width_m = {1.74, 1.9};
  type.height_m = {1.4, 1.5};
  type.clearance_m = {0.13, 0.17};
  type.wheel_radius_m = {0.31, 0.34};
  type.roof_width_ratio = {0.64, 0.72};
  type.belt_z_ratio = 0.65;
  type.belt_x_ratio = {-0.34, 0.24};
  type.roof_x_ratio = {-0.21, 0.08};
  return type;
}

CarType estate() {
  CarType type = saloon();
  type.length_m = {4.3, 4.9};
  type.height_m = {1.43, 1.55};
  type.belt_x_ratio = {-0.465, 0.25};
  type.roof_x_ratio = {-0.41, 0.09};
  type.window_ratios = {{0.05, 0.2}, {0.24, 0.5}, {0.53, 0.86}};
  return type;
}

CarType off_roader() {
  CarType type = estate();
  type.length_m = {4.2, 4.9};
  type.width_m = {1.8, 1.95};
  type.height_m = {1.6, 1.85};
  type.clearance_m = {0.2, 0.26};
  type.wheel_radius_m = {0.34, 0.38};
  type.roof_width_ratio = {0.68, 0.76};
  type.belt_z_ratio = 0.62;
  type.nose_z_ratio = 0.54;
  type.roof_x_ratio = {-0.42, 0.12};
  return type;
}

CarType panel_van() {
  CarType type;
  type.length_m = {5.0, 6.5};
  type.width_m = {1.95, 2.05};
  type.height_m = {1.95, 2.65};
  type.clearance_m = {0.18, 0.24};
  type.wheel_radius_m = {0.33, 0.36};
  type.roof_width_ratio = {0.8, 0.84};
  type.belt_z_ratio = 0.5;
  type.nose_z_ratio = 0.42;
  type.belt_x_ratio = {-0.49, 0.37};
  type.roof_x_ratio = {-0.48, 0.27};
  type.window_ratios = {{0.7, 0.9}};
  type.window_top_ratio = 0.75;
  type.has_rear_window = false;
  return type;
}

CarType minibus() {
  CarType type = panel_van();
  type.length_m = {5.0, 6.0};
  type.height_m = {1.95, 2.4};
  type.window_ratios = {{0.04, 0.32}, {0.35, 0.66}, {0.7, 0.9}};
  type.window_top_ratio = 0.8;
  type.has_rear_window = true;
  return type;
}

Cabin draw_cabin(const CarType& type, double length_m, double width_m, double height_m, Rng& rng) {
  const double slide_m = rng.uniform(-0.01, 0.01) * length_m;
  const double roof_width_ratio = draw(rng, type.roof_width_ratio);
  Cabin cabin;
  cabin.belt = {type.belt_z_ratio * height_m, type.belt_x_ratio.from * length_m,
                type.belt_x_ratio.to * length_m + slide_m, 0.43 * width_m};
  // The roof's crown, which the cabin adds, is 4.5 % of its half width high.
  const double roof_half_m = 0.5 * roof_width_ratio * width_m;
  cabin.roof = {height_m - 0.045 * roof_half_m, type.roof_x_ratio.from * length_m,
                type.roof_x_ratio.to * length_m + slide_m, roof_half_m};
  const double belt_m = cabin.belt.front_m - cabin.belt.rear_m;
  for (const Span& window : type.window_ratios) {
    cabin.windows.push_back(
        {cabin.belt.rear_m + window.from * belt_m, cabin.belt.rear_m + window.to * belt_m});
  }
  cabin.window_top_ratio = type.window_top_ratio;
  cabin.has_rear_window = type.has_rear_window;
  cabin.material = draw_coat(rng);
  return cabin;
}

Mesh make_of(const CarType& type, Rng& rng) {
  BodyShape shape;
  shape.length_m = draw(rng, type.length_m);
  shape.width_m = draw(rng, type.width_m);
  const double height_m = draw(rng, type.height_m);
  shape.clearance_m = draw(rng, type.clearance_m);
  shape.wheel_radius_m = draw(rng, type.wheel_radius_m);
  shape.front_axle_m = 0.5 * shape.length_m - rng.uniform(0.78, 0.9);
  shape.rear_axle_m = -0.5 * shape.length_m + rng.uniform(0.72, 0.95);
  shape.nose_m = type.nose_z_ratio * height_m;
  shape.cabin = draw_cabin(type, shape.length_m, shape.width_m, height_m, rng);
  shape.tail_m = shape.cabin.belt.z_m - 0.04;
  Mesh mesh;
  add_body(mesh, shape);
  return mesh;
}

}  // namespace

Mesh make_car(Rng& rng) {
  static const std::vector<CarType> types = {CarType{}, saloon(), estate(), off_roader()};
  return make_of(pick(types, rng), rng);
}

Mesh make_van(Rng& rng) {
  static const std::vector<CarType> types = {panel_van(), minibus()};
  return make_of(pick(types, rng), rng);
}

}  // namespace croon::simulation
