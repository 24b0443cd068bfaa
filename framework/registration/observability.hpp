#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "framework/geometry/pose_covariance.hpp"

namespace croon {

/// A degree of freedom is weak if its information is below this multiple of the information that
/// noise alone would produce.
inline constexpr double kWeakRatio = 10.0;
/// A degree of freedom is unobservable if its information is below this multiple of it.
inline constexpr double kUnobservableRatio = 2.0;

/// How well the data constrain a degree of freedom.
struct DofConstraint {
  Observability word = Observability::unobservable;
  /// The motion of the pose by one unit of it, with all free degrees of freedom following such that
  /// the opposing information is minimal.
  Vector6d motion = Vector6d::Zero();
};

/// Classifies a degree of freedom by the covariance of a pose in which others are free.
using JudgeDof = std::function<Observability(std::size_t dof, const Matrix6d& covariance)>;

/// Classifies each degree of freedom with all others free, by `covariance`, the inverse of
/// `information`. Then those that are not `determined` and follow another one are classified again
/// with the leading ones fixed. One follows another if it moves because of it: in units of an
/// unknown pose, their covariance is more than four times its own variance. The others that are not
/// determined lead. For example, on a plain seen by a reference that is tilted by up to 14 degrees,
/// roll follows yaw, because the rotation about the plain's normal, which is unconstrained, is
/// mostly yaw.
DofObservability judged_dofs(const Matrix6d& covariance, const Matrix6d& information,
                             const JudgeDof& judge);

/// Compares, for each degree of freedom with all others free (the Schur complement), the
/// `information` from the normals of surfaces with the part of it that their `noise` alone would
/// produce: all information about an unconstrained direction is noise. So the result depends
/// neither on units nor on other directions. `prior` is the weak information assumed for every pose
/// before the points are used, in the same units. Without it, not even roll would be constrained on
/// a plain, because a translation of kilometres could compensate for it. Degrees of freedom that
/// follow another one are classified with that one fixed (judged_dofs).
std::array<DofConstraint, 6> dof_constraints(const Matrix6d& information, const Matrix6d& noise,
                                             const Matrix6d& prior, double weak_ratio = kWeakRatio,
                                             double unobservable_ratio = kUnobservableRatio);

}  // namespace croon
