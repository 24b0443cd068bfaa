#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/sensor_views.hpp"

namespace croon {

// What reports show of a calibration: the clouds of one scene at the poses along the pipeline, and
// how well the surfaces of the sensors agree at the result.

/// A point of a sensor and the nearest surface that other sensors measured.
struct Residual {
  double azimuth_deg = 0.0;    ///< In the frame of the sensor.
  double elevation_deg = 0.0;  ///< In the frame of the sensor.
  double range_m = 0.0;
  double incidence_deg = 0.0;  ///< Between the ray and the normal of the surface, 0 to 90.
  double distance_m = 0.0;     ///< Along the normal; positive if the point is farther away.
};

/// Distances of the points of a cloud to the nearest surfaces; NaN without a surface nearby.
using Distances = std::vector<float>;

/// One sensor of the scene.
struct ViewedSensor {
  std::string sensor;
  bool is_reference = false;
  bool is_accepted = false;
  Points points;  ///< In the frame of the sensor.
  /// T_level_sensor by state; std::nullopt before a step has found a pose.
  std::vector<std::optional<RigidTransform>> poses;
  std::optional<RigidTransform> rival;         ///< T_level_sensor, see ShownSensor.
  std::map<std::size_t, Distances> distances;  ///< By state, for the first and the last of them.
  std::vector<Residual> residuals;             ///< At the last state.
  std::optional<Refit> refit;  ///< std::nullopt for the reference and without overlap.
};

/// How well two sensors agree at the result.
struct SensorAgreement {
  std::string a, b;
  double overlap_ratio = 0.0;      ///< Of the points of both, the share with a surface nearby.
  double median_distance_m = 0.0;  ///< Of these points, the median distance to the surface.
  std::size_t points = 0;          ///< Their number.
};

/// A place where a misalignment would show, in the level frame.
struct CloseUp {
  std::string title;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double half_width_m = 2.0;
};

/// The view of a rig.
struct RigView {
  std::string scene;
  LevelFrame level;
  std::vector<std::string> states;     ///< "nominal", steps that changed a pose, "result".
  std::vector<ViewedSensor> sensors;   ///< The reference first.
  std::vector<SensorAgreement> pairs;  ///< Pairs of sensors with overlap, by name.
  std::vector<CloseUp> close_ups;      ///< At most three.
};

/// A cloud to be viewed.
struct ViewedCloud {
  std::string sensor;
  std::shared_ptr<const Cloud> cloud;
  bool is_accepted = false;
  std::vector<std::optional<RigidTransform>> poses;  ///< T_reference_sensor by state.
  std::optional<RigidTransform> rival = {};          ///< T_reference_sensor.
};

/// The view of a reference, the first of `clouds`, and of other sensors. A surface is near if it is
/// within 0.3 m; surfaces of rejected sensors do not count. Same bits for any number of threads.
RigView view_of(const std::string& scene, const std::vector<std::string>& states,
                const std::vector<ViewedCloud>& clouds);

/// The view of `rig.shown`, with the refits of its sensors; without sensors if nothing is shown.
RigView rig_view(const CalibratedRig& rig);

}  // namespace croon
