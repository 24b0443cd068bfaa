#pragma once

#include <string>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/registration/sensor_view.hpp"

namespace croon {

/// Poses that may explain the views nearly as well as `T_target_source`, to be registered and
/// compared with it (see lead_over): those of the `proposed` ones whose score (PoseEvidence::score,
/// from an eighth of the points) is at most 0.5 below that of the pose, and shifts of up to
/// `max_shift_m` along the two directions in which the surfaces constrain the pose least, at which
/// the score has its best local maxima, as along a row of equal niches. The best first, none near
/// the pose or near each other.
std::vector<RigidTransform> rival_poses(const SensorView& target, const SensorView& source,
                                        const RigidTransform& T_target_source,
                                        const std::vector<RigidTransform>& proposed,
                                        double max_shift_m);

/// How `rival` differs from `T_target_source`, in the axes of the target: "turned by 180 degrees"
/// for rotations above 5 degrees, otherwise "3.0 m further along -x".
std::string difference_in_words(const RigidTransform& rival, const RigidTransform& T_target_source);

}  // namespace croon
