#pragma once

#include <string>
#include <vector>

#include "framework/geometry/dof.hpp"
#include "framework/registration/sensor_view.hpp"

namespace croon {

/// A direction of motion of a pose, and how strongly surfaces constrain it.
struct ConstraintDirection {
  Vector6d motion = Vector6d::Zero();  ///< Of `moved`: radians, metres; points move by 1 m.
  double strength = 0.0;  ///< In [0, 1]: 0 unconstrained, 1 if all points move along normals.
};

/// The directions of motion of the points of `source` that lie on surfaces of `target`, the least
/// constrained first. `strength` is the share of the mean squared motion of these points that is
/// along the normals of the surfaces: the directions are the eigenvectors of the point-to-plane
/// normal equations relative to those of point to point (after Gelfand et al., Geometrically stable
/// sampling for the ICP algorithm, 2003, who scale rotations by the radius of the cloud). Empty if
/// fewer than six points correspond.
std::vector<ConstraintDirection> constraint_directions(const SensorView& target,
                                                       const SensorView& source,
                                                       const RigidTransform& T_target_source,
                                                       double max_distance_m);

/// The names of the degrees of freedom that contribute to the motions: "x, y and yaw".
std::string dof_names_of(const std::vector<ConstraintDirection>& directions);

}  // namespace croon
