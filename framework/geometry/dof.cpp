#include "framework/geometry/dof.hpp"

namespace croon {

RigidTransform moved(const RigidTransform& T_target_source, const Vector6d& offset) {
  return {rotation_from_rpy(offset.head<3>()) * T_target_source.rotation,
          T_target_source.translation + offset.tail<3>()};
}

}  // namespace croon
