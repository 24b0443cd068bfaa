#pragma once

#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/params/table.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// Azimuth error of a spinning LiDAR (reported minus true), in radians, at the azimuth a and the
/// elevation e of a point in the sensor's own frame, which rotates about z:
/// `offset + sine sin a + cosine cos a + slope e`. The once-per-turn part is that of an encoder
/// with an eccentric disc, the slope that of a column of lasers rolled about its beams (Lichti,
/// Error modelling, calibration and analysis of an AM-CW terrestrial laser scanner system, 2007;
/// Muhammad and Lacroix, Calibration of a rotating multi-beam lidar, 2010).
struct AzimuthError {
  double offset_rad = 0.0;
  double sine_rad = 0.0;
  double cosine_rad = 0.0;
  double slope = 0.0;  ///< Radians per radian.

  /// The error at `point`, in metres in the sensor's frame.
  double at(const Eigen::Vector3d& point) const;
};

/// `point` with its azimuth corrected for the error.
Eigen::Vector3d without_error(const Eigen::Vector3d& point, const AzimuthError& error);

/// `cloud` with its points corrected; its channels stay.
PointCloud without_error(PointCloud cloud, const AzimuthError& error);

/// One scene in which a sensor's azimuths are compared with a target's surfaces.
struct AzimuthView {
  const Cloud* target = nullptr;
  const Cloud* source = nullptr;
  RigidTransform T_target_source;
};

/// The parameters of calibrate_azimuth.
struct AzimuthOptions {
  double max_distance_m = 0.3;
  int points = 20000;
  int normal_neighbours = 10;
  double max_normal_angle_deg = 45.0;
  double direction_balance = 0.5;
  double kernel_width_m = 0.05;
  double surface_size_m = 8.0;
  double prior_std_deg = 0.5;
  int max_iterations = 60;
};

/// The rows of AzimuthOptions.
const params::Table<AzimuthOptions>& azimuth_table();

/// Views with fewer correspondences are skipped.
inline constexpr int kMinAzimuthCorrespondences = 30;

/// The azimuth error of a sensor, and its pose without it in each view.
struct AzimuthCalibration {
  AzimuthError error;
  /// Of sine, cosine and slope, rad^2; the errors of points on one surface count as a single error.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::vector<RigidTransform> T_target_source;  ///< By view.
  double rmse_before_m = 0.0;  ///< Weighted, of the distances to surfaces, at the initial poses
                               ///< without an error.
  double rmse_m = 0.0;         ///< The same at the end.
  /// By view. A view with fewer than kMinAzimuthCorrespondences keeps its initial pose and does
  /// not contribute to the error.
  std::vector<int> correspondences;
  double surfaces = 0.0;  ///< Effective number (equally weighted) of surfaces over all views.
  int iterations = 0;
  bool converged = false;

  /// The distance of sine, cosine and slope from zero in standard deviations: the root of a third
  /// of their squared Mahalanobis distance, about 1 for a sensor without an error. 0 if there are
  /// too few surfaces to tell.
  double significance() const;
};

/// Estimates the azimuth error of one sensor, the same in all `views`, together with its pose in
/// each: robust least squares of the distances of its points to the surfaces of the targets,
/// starting at the poses of the views. A constant error is equivalent to a yaw of the mounting, so
/// the offset is chosen such that the mean error over all points is zero. The prior of sine, cosine
/// and slope has the standard deviation `prior_std_deg` about zero. Throws StageError if all
/// views have too few correspondences.
AzimuthCalibration calibrate_azimuth(const std::vector<AzimuthView>& views,
                                     const AzimuthOptions& options);

}  // namespace croon
