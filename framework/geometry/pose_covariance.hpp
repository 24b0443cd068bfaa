#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/geometry/dof.hpp"

namespace croon {

/// How well the data constrain a degree of freedom of a pose.
enum class Observability {
  determined,   ///< Constrained by surfaces, well above the noise of points and normals.
  weak,         ///< Constrained, but not far above the noise.
  unobservable  ///< Any constraint is indistinguishable from noise.
};

/// All values of Observability, from best to worst, and their names.
inline constexpr std::array kObservabilities = {Observability::determined, Observability::weak,
                                                Observability::unobservable};
inline constexpr std::array<const char*, 3> kObservabilityNames = {"determined", "weak",
                                                                   "unobservable"};

inline const char* name_of(Observability word) {
  return kObservabilityNames.at(static_cast<std::size_t>(word));
}

/// The value with this name; std::nullopt for an unknown name.
std::optional<Observability> observability_of(const std::string& name);

/// The observability of each degree of freedom, by Dof.
using DofObservability = std::array<Observability, 6>;

/// The better and the worse of two values, for each degree of freedom.
DofObservability best_observability(const DofObservability& a, const DofObservability& b);
DofObservability worst_observability(const DofObservability& a, const DofObservability& b);

/// The uncertainty of an estimate of `T_reference_sensor`: the covariance of its error as
/// `pose_error` measures it, `e = (roll, pitch, yaw of T_estimate T_truth^-1, t_estimate -
/// t_truth)`, in rad and m, in the reference frame. To first order, the true pose is
/// `moved(T_estimate, -e)`: the rotation is about the sensor's own origin, applied from the left.
struct PoseCovariance {
  Matrix6d matrix = Matrix6d::Zero();
  DofObservability dofs = {};
};

/// The maximum variance in a covariance, rad^2 or m^2.
inline constexpr double kMaxVariance = 1e12;

/// Whether `matrix` can be the covariance of a pose: symmetric to the last bit, finite, positive
/// semi-definite up to rounding, no variance above `kMaxVariance`.
bool is_covariance(const Matrix6d& matrix);

/// The standard deviations of an unconstrained degree of freedom: any angle, and 10 m.
inline constexpr double kUnknown_rad = 1.8;
inline constexpr double kUnknown_m = 10.0;
/// The corresponding variances, in the order of Dof.
Vector6d unknown_variances();

/// The uncertainty `covariance` limited to that of an unknown pose: `(C^-1 + P^-1)^-1`, with P the
/// diagonal of unknown_variances. Directions lost to rounding next to the maximum variance count as
/// unknown.
Matrix6d bounded_covariance(const Matrix6d& covariance);

/// The uncertainty of `T_a_b T_b_c` from the independent uncertainties of both: to first order, the
/// rotation error of T_a_b also moves the origin of c. A degree of freedom is as observable as the
/// worst of those that it is composed of.
PoseCovariance composed_covariance(const RigidTransform& T_a_b, const PoseCovariance& of_a_b,
                                   const RigidTransform& T_b_c, const PoseCovariance& of_b_c);

/// The covariance of the mean of n poses with independent errors: the sum over n^2. Each degree of
/// freedom has its worst observability over all scenes. Throws std::logic_error for an empty list.
PoseCovariance covariance_of_mean(const std::vector<PoseCovariance>& covariances);

/// The covariance of a result on which several dependent estimates, e.g. from the same data, agree:
/// the mean of theirs, with the worst observability. Throws std::logic_error for an empty list.
PoseCovariance mean_covariance(const std::vector<PoseCovariance>& covariances);

}  // namespace croon
