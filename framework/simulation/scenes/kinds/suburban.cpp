#include "framework/simulation/scenes/scene.hpp"

#include "framework/simulation/scenes/boundaries.hpp"
#include "framework/simulation/scenes/houses.hpp"
#include "framework/simulation/scenes/street.hpp"

namespace croon::simulation {
namespace {

constexpr Span kSuburb_m = {-110.0, 110.0};

/// A narrow road with one lane each way and, if it is wide enough, parked cars.
Street draw_suburban_street(Rng& rng) {
  Street street;
  street.shape = draw_road(rng);
  street.lanes.width_m = rng.uniform(2.8, 3.3);
  const bool is_wide = chance(rng, 0.6);
  street.shape.half_width_m = street.lanes.edge_m() + (is_wide ? 2.1 : 0.3);
  street.has_parking = {is_wide, is_wide};
  street.shape.pavement_width_m = rng.uniform(1.8, 3.2);
  street.shape.kerb_height_m = rng.uniform(0.08, 0.12);
  if (chance(rng, 0.5)) street.shape.lines = lane_lines(street.lanes, false);
  street.speed_mps = chance(rng, 0.2) ? 0.0 : rng.uniform(4.0, 11.0);
  return street;
}

void add_suburban_side(SceneBuilder& builder, const Street& street, const Roadside& side,
                       const StreamKey& key) {
  Rng rng(key.with("side"));
  const double kerb_m = street.shape.half_width_m;
  const Pavement pavement = {kerb_m, street.shape.pavement_width_m, 0.3};
  const double verge_m = chance(rng, 0.5) ? rng.uniform(0.8, 3.0) : 0.0;
  const double back_m = kerb_m + pavement.width_m;
  const double parked_share = rng.uniform(0.05, 0.35);
  const int people = draw_int(rng, 0, 4);
  if (verge_m > 0.0) {
    add_boundary_pieces(builder, side, {-35.0, 35.0}, back_m + 0.3, {BoundaryType::tufts, 0.5},
                        Rng(key.with("tufts")));
  }
  add_plots(builder, side, kSuburb_m, back_m + verge_m, key.with("plots"));
  if (street.has_parking[0]) {
    add_parked_row(builder, side, kSuburb_m, kerb_m - 1.1, parked_share, Rng(key.with("parked")));
  }
  add_furniture(builder, side, kSuburb_m, pavement, key);
  add_people(builder, side, {-40.0, 50.0}, {kerb_m + 0.5, back_m - 0.4}, people,
             Rng(key.with("people")));
}

}  // namespace

World make_suburban(const CarBody& car, const StreamKey& key) {
  Rng rng(key.with("street"));
  const Street street = draw_suburban_street(rng);
  SceneBuilder builder(street.shape, key);
  put_car_on(builder, street, 0, car);
  Traffic traffic;
  traffic.speed_mps = street.speed_mps;
  traffic.gap_m = {20.0, 110.0};
  traffic.bus_share = 0.02;
  add_traffic(builder, street.lanes, kSuburb_m, traffic);
  std::uint64_t number = 0;
  for (const Roadside& side : both_sides()) {
    add_suburban_side(builder, street, side, key.with("side").with(number++));
  }
  return builder.finish();
}

}  // namespace croon::simulation
