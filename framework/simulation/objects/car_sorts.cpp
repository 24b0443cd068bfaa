#include "framework/simulation/objects/car_sorts.hpp"

namespace croon::simulation {
namespace {

CarSort saloon() {
  CarSort sort;
  sort.length_m = {4.3, 5.0};
  sort.width_m = {1.74, 1.9};
  sort.height_m = {1.4, 1.5};
  sort.clearance_m = {0.13, 0.17};
  sort.wheel_radius_m = {0.31, 0.34};
  sort.roof_width_ratio = {0.64, 0.72};
  sort.belt_z_ratio = 0.65;
  sort.belt_x_ratio = {-0.34, 0.24};
  sort.roof_x_ratio = {-0.21, 0.08};
  return sort;
}

CarSort estate() {
  CarSort sort = saloon();
  sort.length_m = {4.3, 4.9};
  sort.height_m = {1.43, 1.55};
  sort.belt_x_ratio = {-0.465, 0.25};
  sort.roof_x_ratio = {-0.41, 0.09};
  sort.window_ratios = {{0.05, 0.2}, {0.24, 0.5}, {0.53, 0.86}};
  return sort;
}

CarSort off_roader() {
  CarSort sort = estate();
  sort.length_m = {4.2, 4.9};
  sort.width_m = {1.8, 1.95};
  sort.height_m = {1.6, 1.85};
  sort.clearance_m = {0.2, 0.26};
  sort.wheel_radius_m = {0.34, 0.38};
  sort.roof_width_ratio = {0.68, 0.76};
  sort.belt_z_ratio = 0.62;
  sort.nose_z_ratio = 0.54;
  sort.roof_x_ratio = {-0.42, 0.12};
  return sort;
}

CarSort panel_van() {
  CarSort sort;
  sort.length_m = {5.0, 6.5};
  sort.width_m = {1.95, 2.05};
  sort.height_m = {1.95, 2.65};
  sort.clearance_m = {0.18, 0.24};
  sort.wheel_radius_m = {0.33, 0.36};
  sort.roof_width_ratio = {0.8, 0.84};
  sort.belt_z_ratio = 0.5;
  sort.nose_z_ratio = 0.42;
  sort.belt_x_ratio = {-0.49, 0.37};
  sort.roof_x_ratio = {-0.48, 0.27};
  sort.window_ratios = {{0.7, 0.9}};
  sort.window_top_ratio = 0.75;
  sort.has_rear_window = false;
  return sort;
}

CarSort minibus() {
  CarSort sort = panel_van();
  sort.length_m = {5.0, 6.0};
  sort.height_m = {1.95, 2.4};
  sort.window_ratios = {{0.04, 0.32}, {0.35, 0.66}, {0.7, 0.9}};
  sort.window_top_ratio = 0.8;
  sort.has_rear_window = true;
  return sort;
}

}  // namespace

const std::vector<CarSort>& car_sorts() {
  static const std::vector<CarSort> sorts = {CarSort{}, saloon(), estate(), off_roader()};
  return sorts;
}

const std::vector<CarSort>& van_sorts() {
  static const std::vector<CarSort> sorts = {panel_van(), minibus()};
  return sorts;
}

}  // namespace croon::simulation
