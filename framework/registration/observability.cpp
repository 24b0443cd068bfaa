#include "framework/registration/observability.hpp"

#include <algorithm>
#include <cmath>

#include "framework/geometry/guarded_inverse.hpp"

namespace croon {
namespace {

/// What held_dofs compares.
struct Evidence {
  const Matrix6d& information;
  const Matrix6d& noise;
  double weak_ratio;
  double unobservable_ratio;
};

/// With the degrees of freedom free of which `covariance` is that of the information about any pose
/// and the evidence.
HeldDof judged(const Evidence& evidence, const Matrix6d& covariance, std::size_t dof) {
  const auto i = static_cast<Eigen::Index>(dof);
  HeldDof held;
  held.motion = covariance.col(i) / covariance(i, i);
  const double found = held.motion.dot(evidence.information * held.motion);
  const double pretended = held.motion.dot(evidence.noise * held.motion);
  if (found > evidence.weak_ratio * pretended) {
    held.word = Observability::determined;
  } else if (found > evidence.unobservable_ratio * pretended) {
    held.word = Observability::weak;
  }
  return held;
}

}  // namespace

std::array<bool, 6> leading_dofs(const DofWords& words, const Matrix6d& covariance) {
  constexpr double kFollows = 4.0;
  const Vector6d scale = unknown_variances().cwiseSqrt().cwiseInverse();
  const Matrix6d scaled = scale.asDiagonal() * covariance * scale.asDiagonal();
  std::array<bool, 6> leads{};
  for (std::size_t dof = 0; dof < words.size(); ++dof) {
    const auto i = static_cast<Eigen::Index>(dof);
    const bool follows = scaled.col(i).cwiseAbs().maxCoeff() > kFollows * scaled(i, i);
    leads[dof] = words[dof] != Observability::determined && !follows;
  }
  return leads;
}

Matrix6d with_held(const Matrix6d& information, const std::array<bool, 6>& held) {
  Matrix6d result = information;
  for (std::size_t dof = 0; dof < held.size(); ++dof) {
    if (!held[dof]) continue;
    const auto i = static_cast<Eigen::Index>(dof);
    result.row(i).setZero();
    result.col(i).setZero();
    result(i, i) = information(i, i);
  }
  return result;
}

std::array<HeldDof, 6> held_dofs(const Matrix6d& information, const Matrix6d& noise,
                                 const Matrix6d& prior, double weak_ratio,
                                 double unobservable_ratio) {
  const Evidence evidence = {information, noise, weak_ratio, unobservable_ratio};
  const Matrix6d covariance = guarded_inverse<6>(information + prior);
  std::array<HeldDof, 6> held;
  DofWords words;
  for (std::size_t dof = 0; dof < held.size(); ++dof) {
    held[dof] = judged(evidence, covariance, dof);
    words[dof] = held[dof].word;
  }
  const std::array<bool, 6> leads = leading_dofs(words, covariance);
  const Matrix6d of_others = guarded_inverse<6>(with_held(information + prior, leads));
  for (std::size_t dof = 0; dof < held.size(); ++dof) {
    if (words[dof] == Observability::determined || leads[dof]) continue;
    held[dof] = judged(evidence, of_others, dof);
  }
  return held;
}

}  // namespace croon
