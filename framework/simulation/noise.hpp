#pragma once

namespace croon::simulation {

/// What a real sensor adds to the ideal ray; all zero is no noise, as in the paper's simulation.
struct Noise {
  double range_std_m = 0.0;    ///< Of each range.
  double angle_std_deg = 0.0;  ///< Of each ray's elevation and azimuth.
  double dropout_ratio = 0.0;  ///< Of rays that are lost whatever they meet.
  double detection_range_m =
      0.0;  ///< Where half of the rays on a 10 % target come back; 0: all do.
  bool sweep_distortion =
      false;  ///< The car and others move during a sweep; else all is of time 0.
};

/// What CARLA does in the paper's samples: no noise, but 15.6 % of all rays are lost (of 1800 rays
/// of a ring that meets the ground all around, 1520 came back).
Noise carla_noise();

/// What a spinning automotive LiDAR of today does: 2 cm, 0.02 degrees, 0.5 %, 10 % targets at 200
/// m.
Noise real_noise();

/// The probability that a ray comes back from `range_m`: a half where the signal, which falls with
/// the square of the range, is that of a perpendicular 10 % target at `detection_range_m`.
/// `signal_ratio` is the share of light that the surface sends back.
double detection_probability(const Noise& noise, double range_m, double signal_ratio);

}  // namespace croon::simulation
