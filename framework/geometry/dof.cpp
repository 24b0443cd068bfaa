#include "framework/geometry/dof.hpp"

#include <algorithm>
#include <stdexcept>

namespace croon {

std::vector<Dof> dofs_from_names(const std::vector<std::string>& names) {
  std::vector<Dof> dofs;
  for (const std::string& name : names) {
    const auto found = std::find(kDofNames.begin(), kDofNames.end(), name);
    if (found == kDofNames.end()) throw std::logic_error("no degree of freedom \"" + name + "\"");
    dofs.push_back(static_cast<Dof>(found - kDofNames.begin()));
  }
  return dofs;
}

RigidTransform moved(const RigidTransform& T_target_source, const Vector6d& offset) {
  return {rotation_from_rpy(offset.head<3>()) * T_target_source.rotation,
          T_target_source.translation + offset.tail<3>()};
}

}  // namespace croon
