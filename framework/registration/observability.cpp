#include "framework/registration/observability.hpp"

#include "framework/geometry/guarded_inverse.hpp"

namespace croon {
namespace {

/// Which degrees of freedom lead, see judged_dofs.
std::array<bool, 6> leading_dofs(const DofObservability& words, const Matrix6d& covariance) {
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

/// `information` with the degrees of freedom in `held` decoupled from the others: their
/// off-diagonal entries are zero.
Matrix6d with_fixed(const Matrix6d& information, const std::array<bool, 6>& held) {
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

}  // namespace

DofObservability judged_dofs(const Matrix6d& covariance, const Matrix6d& information,
                             const JudgeDof& judge) {
  DofObservability words;
  for (std::size_t dof = 0; dof < words.size(); ++dof) words[dof] = judge(dof, covariance);
  const std::array<bool, 6> leads = leading_dofs(words, covariance);
  const Matrix6d of_others = guarded_inverse<6>(with_fixed(information, leads));
  for (std::size_t dof = 0; dof < words.size(); ++dof) {
    const bool follows = words[dof] != Observability::determined && !leads[dof];
    if (follows) words[dof] = judge(dof, of_others);
  }
  return words;
}

std::array<DofConstraint, 6> dof_constraints(const Matrix6d& information, const Matrix6d& noise,
                                             const Matrix6d& prior, double weak_ratio,
                                             double unobservable_ratio) {
  std::array<DofConstraint, 6> held;
  const auto judge = [&](std::size_t dof, const Matrix6d& covariance) {
    const auto i = static_cast<Eigen::Index>(dof);
    Vector6d& motion = held[dof].motion;
    motion = covariance.col(i) / covariance(i, i);
    const double found = motion.dot(information * motion);
    const double by_noise = motion.dot(noise * motion);
    if (found > weak_ratio * by_noise) return Observability::determined;
    return found > unobservable_ratio * by_noise ? Observability::weak
                                                 : Observability::unobservable;
  };
  const Matrix6d all = information + prior;
  const DofObservability words = judged_dofs(guarded_inverse<6>(all), all, judge);
  for (std::size_t dof = 0; dof < held.size(); ++dof) held[dof].word = words[dof];
  return held;
}

}  // namespace croon
