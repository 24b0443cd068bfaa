#include "framework/simulation/world.hpp"

#include <cmath>

namespace croon::simulation {

RigidTransform Body::pose_at(double time_s) const {
  const double turn_rad = motion.yaw_rate_radps * time_s;
  const double length_m = motion.speed_mps * time_s;
  // An arc of that length, turning steadily; its chord is 2 / kappa sin(turn / 2) long.
  const double half_rad = 0.5 * turn_rad;
  const double chord_m =
      std::abs(half_rad) < 1e-9 ? length_m : length_m * std::sin(half_rad) / half_rad;
  const RigidTransform moved = {rotation_from_rpy({0.0, 0.0, turn_rad}),
                                {chord_m * std::cos(half_rad), chord_m * std::sin(half_rad), 0.0}};
  return T_world_body * moved;
}

}  // namespace croon::simulation
