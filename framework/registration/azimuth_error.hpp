#pragma once

#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/params/table.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// What a spinning LiDAR reports too much of azimuth, in radians, at the azimuth a and the
/// elevation e of a point in its own frame, which turns about z:
/// `offset + sine sin a + cosine cos a + slope e`. The once-per-turn part is that of an encoder
/// whose disc is not centred, the slope that of a column of lasers that is rolled about its beams
/// (Lichti, Error modelling, calibration and analysis of an AM-CW terrestrial laser scanner system,
/// 2007; Muhammad and Lacroix, Calibration of a rotating multi-beam lidar, 2010).
struct AzimuthError {
  double offset_rad = 0.0;
  double sine_rad = 0.0;
  double cosine_rad = 0.0;
  double slope = 0.0;  ///< Radians per radian.

  /// At `point`, in metres in the sensor's frame.
  double at(const Eigen::Vector3d& point) const;
};

/// `point` at the azimuth that it would have without the error.
Eigen::Vector3d without_error(const Eigen::Vector3d& point, const AzimuthError& error);

/// `cloud` with its points without the error; its channels stay.
PointCloud without_error(PointCloud cloud, const AzimuthError& error);

/// One scene in which a sensor's azimuths are compared with a target's surfaces.
struct AzimuthView {
  const Cloud* target = nullptr;
  const Cloud* source = nullptr;
  RigidTransform T_target_source;
};

/// How an azimuth error is estimated.
struct AzimuthOptions {
  double max_distance_m = 0.3;
  int points = 20000;
  int normal_neighbours = 10;
  double max_normal_angle_deg = 45.0;
  double direction_balance = 0.5;
  double kernel_width_m = 0.05;
  double surface_size_m = 8.0;
  double expected_error_deg = 0.5;
  int max_iterations = 60;
};

/// The rows of AzimuthOptions.
const params::Table<AzimuthOptions>& azimuth_table();

/// A view in which less points correspond takes no part.
inline constexpr int kFewestAzimuthCorrespondences = 30;

/// The azimuth error of a sensor, and its pose without it in each view.
struct AzimuthCalibration {
  AzimuthError error;
  /// Of sine, cosine and slope, rad^2: the errors of all points of one surface are taken as one.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::vector<RigidTransform> T_target_source;  ///< By view.
  double rmse_before_m = 0.0;  ///< Weighted, of the distances to surfaces, with the start's poses
                               ///< and no error.
  double rmse_m = 0.0;         ///< The same at the end.
  /// By view. In one with less than kFewestAzimuthCorrespondences the pose is the start's, and the
  /// error does not follow from it.
  std::vector<int> correspondences;
  double surfaces = 0.0;  ///< On which the points lie, of all views; as many of one weight.
  int iterations = 0;
  bool converged = false;

  /// How many standard deviations sine, cosine and slope are from zero: the root of a third of
  /// their squared Mahalanobis distance, about 1 for a sensor without an error. 0 if the points lie
  /// on too few surfaces to tell.
  double significance() const;
};

/// Finds the azimuth error of one sensor, the same in all `views`, together with its pose in each:
/// least squares of the distances of its points to the surfaces of the targets, robust, from the
/// poses of the views. An error that is the same at all azimuths is a yaw of the mounting, so the
/// offset is the one that makes the mean error of all points zero. Of sine, cosine and slope a
/// standard deviation of `expected_error_deg` about zero is expected. Throws StageError if too few
/// points correspond in all views.
AzimuthCalibration calibrate_azimuth(const std::vector<AzimuthView>& views,
                                     const AzimuthOptions& options);

}  // namespace croon
