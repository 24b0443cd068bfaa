#pragma once

#include <array>
#include <string>

#include "framework/geometry/point_cloud.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "framework/picture/cloud_view.hpp"

namespace croon {

// Chooses the views of a sensor's picture from the clouds.

/// Sizes of the views.
inline constexpr int kPanelWidth_px = 640;
inline constexpr int kTopHeight_px = 480;
inline constexpr int kSectionHeight_px = 190;

/// The frame in which a rig is drawn: above the reference's ground, z up.
struct LevelFrame {
  RigidTransform T_level_reference;
  /// Whether z = 0 is the ground; otherwise this is the reference's own frame.
  bool has_ground = false;
};

/// The level frame of a reference that measured `points`; its own frame if it sees no ground.
LevelFrame level_frame(const Points& points);

/// The points, in the level frame, that are above the ground; all points if these are few or there
/// is no ground.
Points above_ground(const Points& points, const LevelFrame& level);

/// Points of a column at one pose, from which views are chosen.
struct ShownPoints {
  Points reference, sensor;  ///< Above the ground, away from the car's own body.
  Points shared;             ///< Those of the sensor with points of the reference nearby.
};

/// Selects from points above the ground; points and origins are in the level frame.
ShownPoints shown_points(const Points& reference, const Points& sensor,
                         const Eigen::Vector3f& reference_origin_m,
                         const Eigen::Vector3f& sensor_origin_m);

/// A row of the picture.
struct PictureRow {
  CloudView view;
  std::string caption;
  bool shows_ground = true;
};

/// The view from above of the common area, and at its scale the sections, 1 m thick, in which both
/// clouds have the most points.
std::array<PictureRow, 3> rows_of(const ShownPoints& shown, bool has_ground);

}  // namespace croon
