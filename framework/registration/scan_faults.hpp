#pragma once

#include <vector>

#include "framework/registration/surface_touches.hpp"

namespace croon {

/// The ranges of a sensor minus those of the target, `offset_m + scale * range`, and the covariance
/// of the error of (scale, offset_m).
struct RangeDifference {
  double scale = 0.0;
  double offset_m = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double median_range_m = 0.0;  ///< Of the points that lie on surfaces of the target.
};

/// The shift of the points whose azimuth (in the sensor's frame) lies in the half turn from
/// `azimuth_rad` on, relative to the other points, in the target's frame.
struct HalfShift {
  double azimuth_rad = 0.0;
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// The robust cost of the distances with the shift, relative to that without.
  double cost_ratio = 1.0;
};

/// Faults of a sensor's scans that no pose explains.
struct ScanFaults {
  RangeDifference range;
  std::vector<HalfShift> halves;  ///< For half turns that begin at 0, 45, 90 and 135 degrees.
  double surfaces = 0.0;          ///< Effective number of surfaces that were compared.
};

/// Estimates the faults of one sensor, the same in all `scans`, each together with its pose in each
/// scan: robust least squares of the distances of its points to the surfaces of the targets. Errors
/// on one surface are not independent: covariances are computed from the scatter over surfaces,
/// regions of 4 m with one direction (sandwich estimator). Where the surfaces do not constrain a
/// fault, its variances are large. A common error of the ranges of both sensors is not observable.
/// Without any surfaces, `surfaces` is 0 and the estimates are meaningless.
ScanFaults estimate_scan_faults(const std::vector<ComparedScan>& scans);

}  // namespace croon
