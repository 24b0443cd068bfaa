#include "framework/registration/observability.hpp"

#include "framework/geometry/guarded_inverse.hpp"

namespace croon {

std::array<HeldDof, 6> held_dofs(const Matrix6d& information, const Matrix6d& noise,
                                 const Matrix6d& prior, double weak_ratio,
                                 double unobservable_ratio) {
  const Matrix6d inverse = guarded_inverse<6>(information + prior);
  std::array<HeldDof, 6> held;
  for (std::size_t dof = 0; dof < held.size(); ++dof) {
    const auto i = static_cast<Eigen::Index>(dof);
    HeldDof& one = held[dof];
    one.motion = inverse.col(i) / inverse(i, i);
    const double found = one.motion.dot(information * one.motion);
    const double pretended = one.motion.dot(noise * one.motion);
    if (found > weak_ratio * pretended) {
      one.word = Observability::determined;
    } else if (found > unobservable_ratio * pretended) {
      one.word = Observability::weak;
    }
  }
  return held;
}

}  // namespace croon
