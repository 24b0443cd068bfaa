#pragma once

#include <string>
#include <vector>

#include "framework/params/table.hpp"

namespace croon {

/// As many as a plan of several variants, scenes and sensors can hold.
inline constexpr int kMaxTrials = 1000000;

/// The centres of starts in JSON.
inline const std::vector<std::string> kStartCentres = {"truth", "nominal", "initial"};

/// The keys of "starts" that say how they are drawn; "sweep" and "file" may stand beside them.
struct StartKeys {
  std::string around = kStartCentres.front();
  double rotation_deg = 45.0;
  double translation_m = 0.1;
  int trials = 50;
};

/// The keys of "sweep" in "starts": of the two ranges there is one.
struct SweepKeys {
  std::vector<double> rotation_deg;
  std::vector<double> translation_m;
  int levels = 11;
};

/// How near the truth a trial must end to count as `success`.
struct SuccessBounds {
  double rotation_deg = 0.5;
  double translation_m = 0.1;
};

/// What the loader reads and the schema tells of StartKeys.
inline const params::Table<StartKeys>& start_table() {
  static const params::Table<StartKeys> table = {
      params::choice("around", &StartKeys::around, kStartCentres,
                     "The pose that starts are drawn around."),
      params::number("rotation_deg", &StartKeys::rotation_deg, {0.0, 180.0},
                     "Half range of roll, pitch and yaw; 180 is any rotation, uniform on SO(3)."),
      params::number("translation_m", &StartKeys::translation_m, {0.0, 1e6},
                     "Half range of x, y and z in reference axes."),
      params::integer("trials", &StartKeys::trials, {1, kMaxTrials},
                      "Starts per variant, scene and sensor; of a sweep per level; of a file the "
                      "first so many, and all where the key is missing."),
  };
  return table;
}

/// What the loader reads and the schema tells of SweepKeys.
inline const params::Table<SweepKeys>& sweep_table() {
  static const params::Table<SweepKeys> table = {
      params::numbers("rotation_deg", &SweepKeys::rotation_deg, {0.0, 180.0},
                      "Smallest and largest angle, about an axis uniform on the sphere."),
      params::numbers("translation_m", &SweepKeys::translation_m, {0.0, 1e6},
                      "Smallest and largest length, along a direction uniform on the sphere."),
      params::integer("levels", &SweepKeys::levels, {2, 1000},
                      "Sizes from the smallest to the largest, in equal steps."),
  };
  return table;
}

/// What the loader reads and the schema tells of SuccessBounds.
inline const params::Table<SuccessBounds>& success_table() {
  static const params::Table<SuccessBounds> table = {
      params::number("rotation_deg", &SuccessBounds::rotation_deg, {0.0, 180.0},
                     "Largest angle between the estimate and the truth."),
      params::number("translation_m", &SuccessBounds::translation_m, {0.0, 1e6},
                     "Largest distance between the estimate and the truth."),
  };
  return table;
}

}  // namespace croon
