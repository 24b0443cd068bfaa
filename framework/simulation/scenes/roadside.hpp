#pragma once

#include "framework/simulation/scenes/builder.hpp"
#include "framework/simulation/scenes/road_box.hpp"

namespace croon::simulation {

/// One side of a road, in its own coordinates: `along_m` (s of the scene's road, d of the road
/// across it) and `out_m`, away from the road's centre line.
struct Roadside {
  double sign = 1.0;          ///< 1: left of the road, or beyond the one across it; -1: the other.
  bool is_across = false;     ///< Of the road across the scene's.
  double crossing_s_m = 0.0;  ///< Where that one is.

  /// A place whose object turns its x axis along the road and its y axis away from it, and then
  /// itself by `turn_rad`.
  Place at(double along_m, double out_m, double turn_rad = 0.0) const;
  /// The box over a stretch of the side.
  RoadBox box(const Interval& along_m, const Interval& out_m, double height_m) const;
  /// What a thing that is `length_m` long needs along the side between the distances `out_m`.
  double along_of(const RoadShape& shape, double length_m, const Interval& out_m) const;
};

/// Turns for Roadside::at: the x axis points to the road, or the way that the traffic of this side
/// goes.
constexpr double kToRoad_rad = -1.5707963267948966;
constexpr double kWithTraffic_rad = 3.141592653589793;

/// Both sides of the scene's road, left first.
std::array<Roadside, 2> both_sides();

/// Things of one sort at intervals along a side.
struct Series {
  Mesh (*make)(Rng& rng) = nullptr;
  int looks = 1;       ///< How many different ones there are.
  Interval spacing_m;  ///< From one to the next.
  Interval out_m;      ///< Where they stand.
  double turn_rad = 0.0;
  bool is_turned_anyhow = false;
  double share = 1.0;  ///< How many of their places are filled.
};

/// Adds the things of `series` along `along_m`, where there is room.
void add_series(SceneBuilder& builder, const Roadside& side, const Interval& along_m,
                const Series& series, Rng rng);

/// `mesh` moved along its x axis so that its middle is at 0.
Mesh centred_along_x(Mesh mesh);

}  // namespace croon::simulation
