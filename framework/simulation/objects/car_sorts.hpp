#pragma once

#include <vector>

#include "framework/simulation/objects/solids.hpp"

namespace croon::simulation {

/// What a sort of car or van is drawn from; the defaults are a hatchback's. Ratios in z are to the
/// height, those in x to the length, from the car's middle forward.
struct CarSort {
  Span length_m = {3.6, 4.3};
  Span width_m = {1.66, 1.8};
  Span height_m = {1.42, 1.56};
  Span clearance_m = {0.15, 0.19};
  Span wheel_radius_m = {0.29, 0.32};
  Span roof_width_ratio = {0.66, 0.74};  ///< Width of the roof to the car's.
  double belt_z_ratio = 0.63;            ///< The belt line.
  double nose_z_ratio = 0.5;             ///< The bonnet's front edge.
  Span belt_x_ratio = {-0.465, 0.27};    ///< Rear and front end of the cabin at the belt line.
  Span roof_x_ratio = {-0.39, 0.11};     ///< The same at the roof.
  /// On each side, from the belt's rear end (0) to its front end (1).
  std::vector<Span> window_ratios = {{0.12, 0.47}, {0.5, 0.86}};
  double window_top_ratio = 0.88;  ///< As Cabin's.
  bool has_rear_window = true;
};

/// Hatchback, saloon, estate and off-roader.
const std::vector<CarSort>& car_sorts();

/// Panel van and minibus.
const std::vector<CarSort>& van_sorts();

}  // namespace croon::simulation
