#pragma once

#include <string>
#include <vector>

#include "framework/geometry/dof.hpp"
#include "framework/registration/sensor_view.hpp"

namespace croon {

/// A direction in which a pose can move, and how firmly surfaces hold it.
struct HeldDirection {
  Vector6d motion = Vector6d::Zero();  ///< Of `moved`: radians, metres; points move by 1 m.
  double strength = 0.0;  ///< In [0, 1]: 0 is free, 1 leads all points straight off their surfaces.
};

/// The directions in which the points of `source` that lie on surfaces of `target` can move, the
/// loosest first. Of the mean squared motion of these points, `strength` is the share along the
/// normals of the surfaces: the eigenvectors of the point-to-plane normal equations against those
/// of point to point (after Gelfand et al., Geometrically stable sampling for the ICP algorithm,
/// 2003, who scale rotations by the radius of the cloud). Empty if fewer than six points
/// correspond.
std::vector<HeldDirection> held_directions(const SensorView& target, const SensorView& source,
                                           const RigidTransform& T_target_source,
                                           double max_distance_m);

/// The degrees of freedom that take part in the motions, in words: "x, y and yaw".
std::string words_of(const std::vector<HeldDirection>& directions);

}  // namespace croon
