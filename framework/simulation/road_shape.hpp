#pragma once

#include <optional>
#include <vector>

#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// A painted line along the road.
struct LaneLine {
  double d_m = 0.0;  ///< Its middle, left of the centre line.
  bool is_dashed = false;
};

/// A second road across the first.
struct Crossing {
  double s_m = 0.0;           ///< Position where the two centre lines cross.
  double half_width_m = 4.0;  ///< Of its carriageway.
};

/// The road of a scene. Road coordinates: `s_m` along the centre line (the car is at 0 and drives
/// towards larger s), `d_m` to the left of the centre line.
struct RoadShape {
  double curvature_per_m = 0.0;  ///< Of the centre line, positive to the left; |d| < 1 / curvature.
  double half_width_m = 4.0;     ///< Of the carriageway, from kerb to kerb.
  double grade = 0.0;            ///< Slope along the road.
  double banking = 0.0;          ///< Slope across the road, rising to the left.
  double crown = 0.0;            ///< Slope from the centre line down to either side.
  double roughness_m = 0.003;    ///< Standard deviation of the surface from the ideal one.
  double kerb_height_m = 0.12;   ///< 0: no kerb.
  double pavement_width_m = 3.0;      ///< Behind the kerb.
  Material behind = Material::grass;  ///< Material behind the pavement.
  double behind_roughness_m = 0.02;   ///< Roughness behind the pavement.
  std::vector<LaneLine> lines;
  std::optional<Crossing> crossing;

  /// Height of the surface without roughness; kerbs are included.
  double height_m(double s_m, double d_m) const;
  /// Standard deviation of the surface's roughness.
  double roughness_at(double s_m, double d_m) const;
  /// Material of the surface.
  Material material_at(double s_m, double d_m) const;

  /// The grid lines over the surface, in ascending order: the s of each line across the road, the d
  /// of each line along it. They follow kerbs and lane lines, are 0.75 m apart near 0 and farther
  /// apart away from it. The grid extends 250 m along the road and 120 m across it, less in a tight
  /// curve.
  std::vector<double> grid_s_m() const;
  std::vector<double> grid_d_m() const;

 private:
  /// Distance to the carriageways, negative on them. The corner between two kerbs is round.
  double beyond_carriageway_m(double s_m, double d_m) const;
  bool is_on_line(double s_m, double d_m) const;
};

}  // namespace croon::simulation
