#pragma once

#include <array>

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
  /// The motion by one unit of it, with all others following such that the least information
  /// resists.
  Vector6d motion = Vector6d::Zero();
};

/// Compares, for each degree of freedom with all others free (the Schur complement), the
/// `information` that the normals of surfaces give with the part of it that their `noise` pretends:
/// where nothing holds a direction, all information about it is noise. So neither units nor other
/// directions matter. `prior` is the information about any pose, in the same units; without it a
/// plain would not hold roll either: a slide by kilometres makes up for it.
std::array<HeldDof, 6> held_dofs(const Matrix6d& information, const Matrix6d& noise,
                                 const Matrix6d& prior, double weak_ratio = kWeakRatio,
                                 double unobservable_ratio = kUnobservableRatio);

}  // namespace croon
