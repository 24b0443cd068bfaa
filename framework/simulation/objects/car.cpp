#include "framework/simulation/draws.hpp"
#include "framework/simulation/objects/car_sorts.hpp"
#include "framework/simulation/objects/vehicle_body.hpp"
#include "framework/simulation/objects/vehicle_types.hpp"

namespace croon::simulation {
namespace {

double draw(Rng& rng, const Span& span) { return rng.uniform(span.from, span.to); }

Cabin draw_cabin(const CarSort& sort, double length_m, double width_m, double height_m, Rng& rng) {
  const double slide_m = rng.uniform(-0.01, 0.01) * length_m;
  const double roof_width_ratio = draw(rng, sort.roof_width_ratio);
  Cabin cabin;
  cabin.belt = {sort.belt_z_ratio * height_m, sort.belt_x_ratio.from * length_m,
                sort.belt_x_ratio.to * length_m + slide_m, 0.43 * width_m};
  // The roof's crown, which the cabin adds, is 4.5 % of its half width high.
  const double roof_half_m = 0.5 * roof_width_ratio * width_m;
  cabin.roof = {height_m - 0.045 * roof_half_m, sort.roof_x_ratio.from * length_m,
                sort.roof_x_ratio.to * length_m + slide_m, roof_half_m};
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
  shape.nose_m = sort.nose_z_ratio * height_m;
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
