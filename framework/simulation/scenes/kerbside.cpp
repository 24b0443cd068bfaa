#include "framework/simulation/scenes/kerbside.hpp"

#include <algorithm>

#include "framework/base/angles.hpp"
#include "framework/simulation/scenes/houses.hpp"

namespace croon::simulation {
namespace {

/// The part of `along_m` near the car. Farther away, small objects are not worth their cost.
Span near_part(const Span& along_m) {
  return {std::max(along_m.from, -kDetail_m), std::min(along_m.to, kDetail_m)};
}

void add_small_objects(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                       const Pavement& pavement, const StreamKey& key) {
  const double strip_m = pavement.kerb_m + 0.7;
  const Span near_kerb_m = {strip_m - 0.1, strip_m + 0.1};
  Rng rng(key.with("small things"));
  Series bollards{make_bollard, 1, {1.6, 1.6}, {strip_m, strip_m}};
  if (chance(rng, 0.3)) {
    const double first_m = rng.uniform(-30.0, 15.0);
    const double length_m = rng.uniform(8.0, 20.0);
    const Span row_m = {std::max(along_m.from, first_m), std::min(along_m.to, first_m + length_m)};
    add_series(builder, side, row_m, bollards, Rng(key.with("bollards")));
  }
  add_series(builder, side, along_m, {make_sign, 2, {12.0, 40.0}, near_kerb_m},
             Rng(key.with("signs")));
  add_series(builder, side, along_m, {make_bin, 1, {15.0, 45.0}, near_kerb_m, 0.0, true},
             Rng(key.with("bins")));
  const double bench_m = pavement.kerb_m + pavement.width_m - 0.6;
  add_series(builder, side, along_m, {make_bench, 1, {18.0, 60.0}, {bench_m, bench_m}, kToRoad_rad},
             Rng(key.with("benches")));
}

}  // namespace

void add_parked_row(SceneBuilder& builder, const Roadside& side, const Span& along_m, double out_m,
                    double share, Rng rng) {
  constexpr double kSpace_m = 5.6;
  for (double from_m = along_m.from; from_m + kSpace_m < along_m.to;) {
    const double gap_m = rng.uniform(0.5, 1.3);
    if (!chance(rng, share)) {
      from_m += kSpace_m + gap_m;
      continue;
    }
    const VehicleType type = chance(rng, 0.06) ? VehicleType::van : VehicleType::car;
    const Vehicle vehicle = make_vehicle(type, rng);
    const double off_m = rng.uniform(-0.12, 0.12);
    const double about_rad = chance(rng, 0.85) ? kWithTraffic_rad : 0.0;
    const double turn_rad = about_rad + rad_from_deg(rng.uniform(-2.0, 2.0));
    const double length_m = vehicle.size_m.x();
    // Wide vehicles park farther from the kerb, so that their wheels do not touch it.
    const double wide_m = std::max(0.0, 0.5 * (vehicle.size_m.y() - 1.85));
    builder.park(vehicle.mesh, side.at(from_m + 0.5 * length_m, out_m + off_m - wide_m, turn_rad));
    from_m += length_m + gap_m;
  }
}

void add_people(SceneBuilder& builder, const Roadside& side, const Span& along_m, const Span& out_m,
                int count, Rng rng) {
  for (int i = 0; i < count; ++i) {
    const Mesh person = make_person(rng);
    const double position_m = draw(rng, along_m);
    const double away_m = draw(rng, out_m);
    const double about_rad = chance(rng, 0.5) ? 0.0 : kPi;
    const double turn_rad = about_rad + rad_from_deg(rng.uniform(-15.0, 15.0));
    const double speed_mps = rng.uniform(0.8, 1.7);
    if (chance(rng, 0.6)) {
      builder.drive(person, side.at(position_m, away_m, turn_rad), speed_mps);
    } else {
      const double stand_rad = rng.uniform(0.0, 2.0 * kPi);
      builder.place_upright(person, side.at(position_m, away_m, stand_rad));
    }
  }
}

void add_furniture(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                   const Pavement& pavement, const StreamKey& key) {
  Rng rng(key.with("furniture"));
  const double strip_m = pavement.kerb_m + 0.7;
  const Span near_m = near_part(along_m);
  const double stop_m = rng.uniform(-25.0, 35.0);
  if (chance(rng, 0.3) && near_m.contains(stop_m)) {
    const double out_m = pavement.kerb_m + std::min(pavement.width_m - 1.0, 2.2);
    builder.place_upright(make_bus_stop(rng), side.at(stop_m, out_m, kToRoad_rad));
  }
  const double lamp_m = rng.uniform(22.0, 34.0);
  add_series(builder, side, along_m,
             {make_lamp, 1, {lamp_m, lamp_m}, {strip_m, strip_m}, kToRoad_rad},
             Rng(key.with("lamps")));
  const double tree_m = rng.uniform(6.0, 12.0);
  const Span tree_out_m = {pavement.kerb_m + 1.0, pavement.kerb_m + 1.3};
  const Series trees{make_tree, 3,    {tree_m, tree_m + 1.0}, tree_out_m,
                     0.0,       true, pavement.tree_share};
  if (chance(rng, 0.85)) add_series(builder, side, along_m, trees, Rng(key.with("trees")));
  add_small_objects(builder, side, near_m, pavement, key);
}

}  // namespace croon::simulation
