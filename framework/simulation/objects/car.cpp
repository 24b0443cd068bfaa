#include "framework/simulation/objects/vehicle_body.hpp"
#include "framework/simulation/objects/vehicle_types.hpp"
#include "framework/simulation/scenes/draws.hpp"

namespace croon::simulation {
namespace {

/// The ranges that a sort of car is drawn from. x of the cabin's edges as ratios of the length,
/// from the car's middle forward.
struct CarSort {
  Span length_m, width_m, height_m, clearance_m, wheel_radius_m;
  Span roof_width_ratio = {0.66, 0.76};  ///< Width of the roof to the car's.
  double belt_ratio = 0.63;              ///< Height of the belt line to the car's.
  double nose_ratio = 0.5;               ///< Height of the bonnet's front edge to the car's.
  double belt_rear_ratio = 0.0, belt_front_ratio = 0.0;
  double roof_rear_ratio = 0.0, roof_front_ratio = 0.0;
  std::vector<Span> window_ratios;  ///< On each side, along the belt from its rear end.
  double window_top_ratio = 0.88;   ///< As Cabin's.
  bool has_rear_window = true;
};

/// Hatchback, saloon, estate and off-roader.
const std::vector<CarSort>& car_sorts() {
  static const std::vector<Span> two = {{0.12, 0.47}, {0.5, 0.86}};
  static const std::vector<Span> three = {{0.05, 0.2}, {0.24, 0.5}, {0.53, 0.86}};
  static const std::vector<CarSort> sorts = {{{3.6, 4.3},
                                              {1.66, 1.8},
                                              {1.42, 1.56},
                                              {0.15, 0.19},
                                              {0.29, 0.32},
                                              {0.66, 0.74},
                                              0.63,
                                              0.5,
                                              -0.465,
                                              0.27,
                                              -0.39,
                                              0.11,
                                              two},
                                             {{4.3, 5.0},
                                              {1.74, 1.9},
                                              {1.4, 1.5},
                                              {0.13, 0.17},
                                              {0.31, 0.34},
                                              {0.64, 0.72},
                                              0.65,
                                              0.5,
                                              -0.34,
                                              0.24,
                                              -0.21,
                                              0.08,
                                              two},
                                             {{4.3, 4.9},
                                              {1.74, 1.88},
                                              {1.43, 1.55},
                                              {0.14, 0.18},
                                              {0.31, 0.34},
                                              {0.66, 0.74},
                                              0.64,
                                              0.5,
                                              -0.465,
                                              0.25,
                                              -0.41,
                                              0.09,
                                              three},
                                             {{4.2, 4.9},
                                              {1.8, 1.95},
                                              {1.6, 1.85},
                                              {0.2, 0.26},
                                              {0.34, 0.38},
                                              {0.68, 0.76},
                                              0.62,
                                              0.54,
                                              -0.465,
                                              0.26,
                                              -0.42,
                                              0.12,
                                              three}};
  return sorts;
}

/// Panel van and minibus.
const std::vector<CarSort>& van_sorts() {
  static const std::vector<Span> three = {{0.04, 0.32}, {0.35, 0.66}, {0.7, 0.9}};
  static const std::vector<CarSort> sorts = {{{5.0, 6.5},
                                              {1.95, 2.05},
                                              {1.95, 2.65},
                                              {0.18, 0.24},
                                              {0.33, 0.36},
                                              {0.8, 0.84},
                                              0.5,
                                              0.42,
                                              -0.49,
                                              0.37,
                                              -0.48,
                                              0.27,
                                              {{0.7, 0.9}},
                                              0.75,
                                              false},
                                             {{5.0, 6.0},
                                              {1.95, 2.05},
                                              {1.95, 2.4},
                                              {0.18, 0.24},
                                              {0.33, 0.36},
                                              {0.78, 0.83},
                                              0.5,
                                              0.42,
                                              -0.49,
                                              0.37,
                                              -0.475,
                                              0.27,
                                              three,
                                              0.8}};
  return sorts;
}

double draw(Rng& rng, const Span& span) { return rng.uniform(span.from, span.to); }

Cabin draw_cabin(const CarSort& sort, double length_m, double width_m, double height_m, Rng& rng) {
  const double slide_m = rng.uniform(-0.01, 0.01) * length_m;
  const double roof_width_ratio = draw(rng, sort.roof_width_ratio);
  Cabin cabin;
  cabin.belt = {sort.belt_ratio * height_m, sort.belt_rear_ratio * length_m,
                sort.belt_front_ratio * length_m + slide_m, 0.43 * width_m};
  // The roof's crown, which the cabin adds, is 4.5 % of its half width high.
  const double roof_half_m = 0.5 * roof_width_ratio * width_m;
  cabin.roof = {height_m - 0.045 * roof_half_m, sort.roof_rear_ratio * length_m,
                sort.roof_front_ratio * length_m + slide_m, roof_half_m};
  const double belt_m = cabin.belt.front_m - cabin.belt.rear_m;
  for (const Span& window : sort.window_ratios) {
    cabin.windows.push_back(
        {cabin.belt.rear_m + window.from * belt_m, cabin.belt.rear_m + window.to * belt_m});
  }
  cabin.window_top_ratio = sort.window_top_ratio;
  cabin.has_rear_window = sort.has_rear_window;
  cabin.material = draw_coat(rng);
  return cabin;
}

Mesh make_one(const CarSort& sort, Rng& rng) {
  BodyShape shape;
  shape.length_m = draw(rng, sort.length_m);
  shape.width_m = draw(rng, sort.width_m);
  const double height_m = draw(rng, sort.height_m);
  shape.clearance_m = draw(rng, sort.clearance_m);
  shape.wheel_radius_m = draw(rng, sort.wheel_radius_m);
  shape.front_axle_m = 0.5 * shape.length_m - rng.uniform(0.78, 0.9);
  shape.rear_axle_m = -0.5 * shape.length_m + rng.uniform(0.72, 0.95);
  shape.nose_m = sort.nose_ratio * height_m;
  shape.cabin = draw_cabin(sort, shape.length_m, shape.width_m, height_m, rng);
  shape.tail_m = shape.cabin.belt.z_m - 0.04;
  Mesh mesh;
  add_body(mesh, shape);
  return mesh;
}

}  // namespace

Mesh make_car(Rng& rng) {
  const CarSort& sort = pick(car_sorts(), rng);
  return make_one(sort, rng);
}

Mesh make_van(Rng& rng) {
  const CarSort& sort = pick(van_sorts(), rng);
  return make_one(sort, rng);
}

}  // namespace croon::simulation
