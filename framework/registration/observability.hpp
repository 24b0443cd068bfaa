#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "framework/geometry/pose_covariance.hpp"

namespace croon {

/// A degree of freedom is weak if the information about it is below so many times what noise
/// pretends.
inline constexpr double kWeakRatio = 10.0;
/// It is unobservable if that is below so many times what noise pretends.
inline constexpr double kUnobservableRatio = 2.0;

/// How well the data hold a degree of freedom.
struct HeldDof {
  Observability word = Observability::unobservable;
  /// The motion by one unit of it, with all others that are free following such that the least
  /// information resists.
  Vector6d motion = Vector6d::Zero();
};

/// The word of a degree of freedom by the covariance of a pose in which others are free.
using JudgeDof = std::function<Observability(std::size_t dof, const Matrix6d& covariance)>;

/// Judges each degree of freedom with all others free, by `covariance`, the inverse of
/// `information`; and then again, with those that lead held, one that is not `determined` and
/// follows another one. One follows another if it moves because that one does: in units of an
/// unknown pose, the covariance of the two is more than four times its own variance. The others
/// that are not determined lead. So on a plain seen by a reference that is tilted by up to 14
/// degrees roll follows yaw, because the turn that the plain does not hold, about its normal, is
/// mostly yaw.
DofWords judged_dofs(const Matrix6d& covariance, const Matrix6d& information,
                     const JudgeDof& judge);

/// Compares, for each degree of freedom with all others free (the Schur complement), the
/// `information` that the normals of surfaces give with the part of it that their `noise` pretends:
/// where nothing holds a direction, all information about it is noise. So neither units nor other
/// directions matter. `prior` is the information about any pose, in the same units; without it a
/// plain would not hold roll either: a slide by kilometres makes up for it. One that follows
/// another one is judged with that one held (judged_dofs).
std::array<HeldDof, 6> held_dofs(const Matrix6d& information, const Matrix6d& noise,
                                 const Matrix6d& prior, double weak_ratio = kWeakRatio,
                                 double unobservable_ratio = kUnobservableRatio);

}  // namespace croon
