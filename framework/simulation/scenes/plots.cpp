#include "framework/simulation/scenes/houses.hpp"

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/scenes/boundaries.hpp"

namespace croon::simulation {
namespace {

constexpr double kDriveway_m = 3.6;

/// A plot with a driveway at its end.
struct Plot {
  Span along_m;
  double out_m = 8.0;      ///< Distance from the centre line to the plot.
  double setback_m = 6.0;  ///< From the front of the plot to the house.

  double driveway_m() const { return along_m.to - 0.5 * kDriveway_m; }
};

void add_house(SceneBuilder& builder, const Roadside& side, const Plot& plot, Rng& rng) {
  const double off_m = rng.uniform(-1.0, 0.5);
  const Mesh house = centred_along_x(make_house(rng));
  builder.place_upright(house, side.at(plot.along_m.middle() + off_m, plot.out_m + plot.setback_m));
}

/// Adds a boundary to the pavement that leaves the driveway open, and one to the next plot.
void add_boundaries(SceneBuilder& builder, const Roadside& side, const Plot& plot, Rng& rng) {
  const std::vector<BoundaryType> types = {BoundaryType::garden_wall, BoundaryType::fence,
                                           BoundaryType::hedge};
  const double front_m = plot.out_m + 0.4;
  const BoundaryType front = pick(types, rng);
  const double height_m = rng.uniform(0.5, 1.0);
  if (chance(rng, 0.75)) {
    add_boundary(
        builder,
        {side.at(plot.along_m.from, front_m), side.at(plot.along_m.to - kDriveway_m, front_m)},
        {front, height_m}, rng);
  }
  const BoundaryType between = pick(types, rng);
  const double deep_m = rng.uniform(6.0, 16.0);
  if (chance(rng, 0.6)) {
    add_boundary(
        builder,
        {side.at(plot.along_m.to, front_m + 0.6), side.at(plot.along_m.to, front_m + deep_m)},
        {between, height_m}, rng);
  }
}

void add_driveway_car(SceneBuilder& builder, const Roadside& side, const Plot& plot, Rng& rng) {
  if (chance(rng, 0.35)) return;
  const Vehicle vehicle = make_vehicle(VehicleType::car, rng);
  const double in_m = rng.uniform(2.8, 4.5);
  const double about_rad = chance(rng, 0.5) ? 0.0 : kPi;
  const double turn_rad = kToRoad_rad + about_rad + rad_from_deg(rng.uniform(-4.0, 4.0));
  builder.park(vehicle.mesh, side.at(plot.driveway_m(), plot.out_m + in_m, turn_rad));
}

/// Adds trees and bushes in the front garden, and trees behind the house.
void add_plants(SceneBuilder& builder, const Roadside& side, const Plot& plot,
                const std::vector<Mesh>& trees, Rng& rng) {
  const Span front_m = {plot.out_m + 1.2, plot.out_m + plot.setback_m - 0.8};
  const Span back_m = {plot.out_m + plot.setback_m + 13.0, plot.out_m + 32.0};
  const int front_trees = draw_int(rng, 0, 2);
  const int back_trees = draw_int(rng, 0, 2);
  const int bushes = draw_int(rng, 0, 4);
  for (int i = 0; i < front_trees + back_trees; ++i) {
    const double along_m = draw(rng, plot.along_m);
    const double out_m = draw(rng, i < front_trees ? front_m : back_m);
    const double turn_rad = rng.uniform(0.0, 2.0 * kPi);
    builder.place_upright(pick(trees, rng), side.at(along_m, out_m, turn_rad));
  }
  for (int i = 0; i < bushes && std::abs(plot.along_m.middle()) < kDetail_m; ++i) {
    const double along_m = draw(rng, plot.along_m);
    const double out_m = draw(rng, front_m);
    builder.place_upright(make_bush(rng), side.at(along_m, out_m));
  }
}

}  // namespace

void add_plots(SceneBuilder& builder, const Roadside& side, const Span& along_m, double out_m,
               const StreamKey& key) {
  Rng tree_rng(key.with("trees"));
  std::vector<Mesh> trees;
  for (int i = 0; i < 3; ++i) trees.push_back(make_tree(tree_rng));
  double from_m = along_m.from;
  for (std::uint64_t number = 0; from_m < along_m.to; ++number) {
    Rng rng(key.with(number));
    Plot plot;
    const double width_m = rng.uniform(17.0, 27.0);
    const double needed_m = side.along_of(builder.shape(), width_m, {out_m, out_m + 15.0});
    plot.along_m = {from_m, from_m + needed_m};
    plot.out_m = out_m;
    plot.setback_m = rng.uniform(4.0, 9.0);
    from_m += needed_m;
    add_house(builder, side, plot, rng);
    if (std::abs(plot.along_m.middle()) < kDetail_m + 15.0) {
      add_boundaries(builder, side, plot, rng);
      add_driveway_car(builder, side, plot, rng);
    }
    add_plants(builder, side, plot, trees, rng);
  }
}

}  // namespace croon::simulation
