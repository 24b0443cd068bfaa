#include "framework/simulation/scenes/houses.hpp"

#include <cmath>

#include "framework/simulation/objects/shapes.hpp"
#include "framework/simulation/scenes/boundaries.hpp"

namespace croon::simulation {
namespace {

constexpr double kFloor_m = 3.0;
constexpr double kMinWidth_m = 9.0;

BuildingSize draw_size(const Fronts& fronts, Rng& rng) {
  BuildingSize size;
  size.width_m = rng.uniform(kMinWidth_m, 22.0);
  size.depth_m = rng.uniform(9.0, 14.0);
  size.floors = draw_int(rng, fronts.floors_low, fronts.floors_high);
  return size;
}

/// Whether an object at `own_m` near the car would extend beyond the end of its row, where another
/// road may be. Far from the car this does not matter.
bool leaves_row(const Span& own_m, const Span& along_m) {
  return std::abs(own_m.middle()) < kDetail_m &&
         (own_m.from < along_m.from || own_m.to > along_m.to);
}

/// The distance from one house to the next.
double draw_gap_m(const Fronts& fronts, Rng& rng) {
  const double share = rng.uniform();
  if (share < fronts.wall_to_wall) return 0.05;
  if (share < 1.0 - fronts.side_street) return rng.uniform(2.0, 9.0);
  return rng.uniform(9.0, 20.0);
}

/// Closes every second gap between houses with a wall, a fence or a hedge.
void close_gap(SceneBuilder& builder, const Roadside& side, const Span& gap_m, double out_m,
               Rng& rng) {
  if (gap_m.length() < 1.5 || gap_m.length() > 8.0 || chance(rng, 0.5)) return;
  const BoundaryType type = pick<BoundaryType>(
      {BoundaryType::garden_wall, BoundaryType::fence, BoundaryType::hedge}, rng);
  const double height_m = rng.uniform(1.2, 2.4);
  add_boundary(builder, {side.at(gap_m.from, out_m), side.at(gap_m.to, out_m)}, {type, height_m},
               rng);
}

}  // namespace

Mesh make_block(const BuildingSize& size, Rng& rng) {
  Mesh mesh;
  const Material material = chance(rng, 0.5) ? Material::plaster : Material::brick;
  add_box(mesh, {0.0, 0.0, -1.0}, {size.width_m, size.depth_m, kFloor_m * size.floors}, material);
  return mesh;
}

void add_fronts(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                const Fronts& fronts, Rng rng) {
  double from_m = along_m.from;
  double last_m = from_m;
  while (from_m < along_m.to) {
    BuildingSize size = draw_size(fronts, rng);
    const double out_m = fronts.out_m + rng.uniform(0.0, 3.0);
    const Span depth_m = {out_m, out_m + size.depth_m};
    const double needed_m = side.along_of(builder.shape(), size.width_m, depth_m);
    Span own_m = {from_m, from_m + needed_m};
    if (leaves_row(own_m, along_m)) {
      own_m.to = along_m.to;
      size.width_m *= own_m.length() / needed_m;
      if (size.width_m < kMinWidth_m) break;
    }
    if (!builder.is_free(side.box(own_m, depth_m, kHeadroom_m))) {
      from_m += 2.0;
      continue;
    }
    const bool is_near = std::abs(own_m.middle()) < kDetail_m;
    const Mesh building = is_near ? make_building(size, rng) : make_block(size, rng);
    if (builder.place_upright(centred_along_x(building), side.at(own_m.middle(), out_m)) &&
        is_near) {
      close_gap(builder, side, {last_m + 0.1, from_m - 0.1}, out_m + 1.0, rng);
    }
    last_m = own_m.to;
    from_m = own_m.to + draw_gap_m(fronts, rng);
  }
}

void add_backdrop(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                  const Span& out_m, Rng rng) {
  Fronts far;
  for (double from_m = along_m.from; from_m < along_m.to; from_m += rng.uniform(25.0, 80.0)) {
    const BuildingSize size = draw_size(far, rng);
    const double away_m = draw(rng, out_m);
    const double half_m = 0.5 * size.width_m;
    if (leaves_row({from_m - half_m, from_m + half_m}, along_m)) continue;
    builder.place_upright(centred_along_x(make_block(size, rng)), side.at(from_m, away_m));
  }
}

}  // namespace croon::simulation
