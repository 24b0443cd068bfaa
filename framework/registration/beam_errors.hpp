#pragma once

#include <optional>
#include <vector>

#include "framework/registration/surface_touches.hpp"

namespace croon {

/// Standard deviations of errors of a LiDAR that all of its scans share: fields over the directions
/// of its beams, in its own frame, that vary slowly. A point at the azimuth a and the elevation e
/// has the errors
///
/// - azimuth: `u1 sin a + u2 cos a + u3 sin 2a + u4 cos 2a + u5 e`,
/// - elevation: `u6 + u7 e`,
/// - range: `u8`,
///
/// with independent u. The first terms are those of an encoder that is off its axis or elliptic and
/// of a rolled column of lasers, the next ones those of a column with an offset and a scale
/// (Lichti, Error modelling, calibration and analysis of an AM-CW terrestrial laser scanner system,
/// 2007). A constant error of azimuth is a rotation of the mounting, and not in the sum.
struct BeamErrors {
  double azimuth_rad = 0.0;    ///< Of u1 to u4 each; of u5 at an elevation of one radian.
  double elevation_rad = 0.0;  ///< Of u6; of u7 at an elevation of one radian.
  double range_m = 0.0;
};

/// The covariance of the error of a pose, the same in all `scans`, that `errors` of the sensor and
/// of the target cause, independently of each other. Each error moves points along the normals of
/// the surfaces that they touch, and the pose follows by weighted least squares; so the covariance
/// depends on the surfaces that the scans have in common. std::nullopt if hardly any points touch.
std::optional<Matrix6d> covariance_of_beam_errors(const std::vector<ComparedScan>& scans,
                                                  const BeamErrors& errors);

}  // namespace croon
