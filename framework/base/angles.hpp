#pragma once

namespace croon {

constexpr double kPi = 3.14159265358979323846;

/// Degrees to radians. JSON and reports are in degrees, everything inside is in radians.
constexpr double rad_from_deg(double angle_deg) { return angle_deg * (kPi / 180.0); }

/// Radians to degrees.
constexpr double deg_from_rad(double angle_rad) { return angle_rad * (180.0 / kPi); }

}  // namespace croon
