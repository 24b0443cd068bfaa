#include <algorithm>
#include <cmath>

#include "framework/simulation/objects/profiles.hpp"

namespace croon::simulation {
namespace {

constexpr double kBridgeFoot_m = -1.0;
constexpr double kSlab_m = 0.35;     ///< Thickness of a deck above its girders.
constexpr double kParapet_m = 0.25;  ///< Thickness of a parapet.

/// The dimensions of a bridge. Lateral positions are relative to the centre line of the road.
struct Bridge {
  Span along_m;
  double low_m = 5.0;        ///< Height of the lower side.
  double top_m = 6.0;        ///< Height of the deck.
  double pier_m = 0.0;       ///< Position of the piers; 0: none.
  double abutment_m = 8.0;   ///< Start of the abutments.
  double approach_m = 60.0;  ///< End of the embankments behind them.
  bool has_girders = false;
  bool has_railing = false;
  double parapet_m = 1.0;
  double pier_radius_m = 0.4;
};

Bridge draw_bridge(const RoadShape& shape, const Span& along_m, Rng& rng) {
  // An embankment ends before the centre of the road's curve.
  const double bend_m = 0.6 / std::max(std::abs(shape.curvature_per_m), 1e-9);
  const double beside_m = shape.half_width_m + std::max(shape.pavement_width_m, 1.0);
  Bridge bridge;
  bridge.along_m = along_m;
  bridge.low_m = rng.uniform(4.8, 5.5);
  bridge.top_m = bridge.low_m + rng.uniform(0.8, 1.2);
  const bool has_piers = chance(rng, 0.5);
  const double pier_m = beside_m + rng.uniform(0.6, 1.2);
  const double span_m = rng.uniform(4.0, 9.0);
  const double wall_m = rng.uniform(0.2, 1.5);
  bridge.pier_m = has_piers ? pier_m : 0.0;
  bridge.abutment_m = has_piers ? pier_m + span_m : beside_m + wall_m;
  const double embankment_m = rng.uniform(28.0, 40.0);
  bridge.approach_m =
      std::max(bridge.abutment_m + 2.0, std::min(bridge.abutment_m + embankment_m, bend_m));
  bridge.has_girders = chance(rng, 0.5);
  bridge.has_railing = chance(rng, 0.5);
  bridge.parapet_m = rng.uniform(0.9, 1.2);
  bridge.pier_radius_m = rng.uniform(0.3, 0.55);
  return bridge;
}

/// The deck, with girders below it or as one slab.
void add_deck(Mesh& mesh, const OverRoad& road, const Bridge& bridge) {
  constexpr double kGirders_m = 2.2;
  constexpr double kWeb_m = 0.45;
  const double half_m = bridge.abutment_m + 0.5;
  const double slab_m = bridge.has_girders ? bridge.top_m - kSlab_m : bridge.low_m;
  add_loft(mesh,
           road.rings(stations_between(bridge.along_m),
                      box_profile({-half_m, slab_m}, {half_m, bridge.top_m})),
           Material::concrete);
  if (!bridge.has_girders) return;
  const double room_m = bridge.along_m.length() - kWeb_m;
  const int gaps = std::max(1, static_cast<int>(room_m / kGirders_m));
  const Profile girder = box_profile({-half_m, bridge.low_m}, {half_m, slab_m});
  for (int i = 0; i <= gaps; ++i) {
    const double s_m = bridge.along_m.from + room_m * i / gaps;
    add_loft(mesh, road.rings({s_m, s_m + kWeb_m}, girder), Material::concrete);
  }
}

/// The wall below each end of the deck and the embankment of the upper road behind it.
void add_abutments(Mesh& mesh, const OverRoad& road, const Bridge& bridge) {
  const std::vector<double> stations_m = stations_between(bridge.along_m);
  for (const double side : {-1.0, 1.0}) {
    const double wall_m = side * bridge.abutment_m;
    const Profile embankment = {{wall_m, kBridgeFoot_m},
                                {wall_m, bridge.top_m},
                                {side * (bridge.abutment_m + 1.0), bridge.top_m},
                                {side * bridge.approach_m, kBridgeFoot_m}};
    add_loft(mesh, road.rings(stations_m, embankment), Material::concrete);
  }
}

/// A parapet along the edge of the deck that begins at `from_s_m`: a wall, or rails on posts.
void add_parapet(Mesh& mesh, const OverRoad& road, const Bridge& bridge, double from_s_m) {
  constexpr double kKerb_m = 0.25;
  const double half_m = bridge.abutment_m + 1.0;
  const std::vector<double> stations_m = {from_s_m, from_s_m + kParapet_m};
  const double wall_m = bridge.has_railing ? kKerb_m : bridge.parapet_m;
  const double top_m = bridge.top_m + wall_m;
  add_loft(mesh, road.rings(stations_m, box_profile({-half_m, bridge.top_m}, {half_m, top_m})),
           Material::concrete);
  if (!bridge.has_railing) return;
  const double middle_m = from_s_m + 0.5 * kParapet_m;
  Path path;
  for (const double d_m : stations_between({-half_m, half_m})) {
    path.push_back(road.point(middle_m, d_m, top_m));
  }
  for (const double rail_m : {0.3, bridge.parapet_m - 0.3}) {
    add_loft(mesh, rings_along(path, box_profile({-0.03, rail_m - 0.03}, {0.03, rail_m + 0.03})),
             Material::metal);
  }
  for (const PathPoint& point : points_along(path, 2.0)) {
    add_pillar(mesh, point, {0.04, 0.03}, 0.0, bridge.parapet_m - 0.27, Material::metal);
  }
}

/// Round piers below both sides of the deck.
void add_piers(Mesh& mesh, const OverRoad& road, const Bridge& bridge) {
  if (bridge.pier_m <= 0.0) return;
  const double in_m = bridge.pier_radius_m + 0.3;
  for (const double s_m :
       stations_between({bridge.along_m.from + in_m, bridge.along_m.to - in_m})) {
    for (const double d_m : {-bridge.pier_m, bridge.pier_m}) {
      add_cylinder(mesh, road.point(s_m, d_m, kBridgeFoot_m), road.point(s_m, d_m, bridge.low_m),
                   bridge.pier_radius_m, bridge.pier_radius_m, 12, Material::concrete);
    }
  }
}

}  // namespace

Mesh make_bridge(const Ground& ground, const Span& along_m, Rng& rng) {
  const Bridge bridge = draw_bridge(ground.shape(), along_m, rng);
  const OverRoad road(ground);
  Mesh mesh;
  add_deck(mesh, road, bridge);
  add_abutments(mesh, road, bridge);
  for (const double s_m : {bridge.along_m.from, bridge.along_m.to - kParapet_m}) {
    add_parapet(mesh, road, bridge, s_m);
  }
  add_piers(mesh, road, bridge);
  return mesh;
}

}  // namespace croon::simulation
