#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/geometry/dof.hpp"

namespace croon {

/// How well the data hold a degree of freedom of a pose.
enum class Observability {
  determined,   ///< Surfaces hold it, well above the noise of points and normals.
  weak,         ///< They hold it, but not far above the noise.
  unobservable  ///< What holds it cannot be told from noise.
};

/// All of Observability, in its order, and their words.
inline constexpr std::array kObservabilities = {Observability::determined, Observability::weak,
                                                Observability::unobservable};
inline constexpr std::array<const char*, 3> kObservabilityNames = {"determined", "weak",
                                                                   "unobservable"};

inline const char* name_of(Observability word) {
  return kObservabilityNames.at(static_cast<std::size_t>(word));
}

/// The word of a name; std::nullopt if it is none.
std::optional<Observability> observability_of(const std::string& name);

/// How well the data hold each degree of freedom, by Dof.
using DofWords = std::array<Observability, 6>;

/// Of each degree of freedom the better of two words, and the worse.
DofWords better_words(const DofWords& a, const DofWords& b);
DofWords worse_words(const DofWords& a, const DofWords& b);

/// The uncertainty of an estimate of `T_reference_sensor`: the covariance of its error as
/// `pose_error` measures it, `e = (roll, pitch, yaw of T_estimate T_truth^-1, t_estimate -
/// t_truth)`, in rad and m, in the reference frame. So the pose `moved(T_estimate, -e)` is the
/// truth to first order: the rotation turns the sensor about its own origin, from the left.
struct PoseCovariance {
  Matrix6d matrix = Matrix6d::Zero();
  DofWords dofs = {};
};

/// The largest variance that a covariance may have, rad^2 or m^2.
inline constexpr double kLargestVariance = 1e12;

/// Whether `matrix` can be the covariance of a pose: symmetric to the last bit, finite, positive
/// semi-definite up to rounding, no variance above `kLargestVariance`.
bool is_covariance(const Matrix6d& matrix);

/// The standard deviations of a degree of freedom that nothing holds: any angle, and 10 m.
inline constexpr double kUnknown_rad = 1.8;
inline constexpr double kUnknown_m = 10.0;
/// Their squares, in the order of Dof.
Vector6d unknown_variances();

/// What is left of the uncertainty `covariance` if no pose can be farther off than an unknown one:
/// `(C^-1 + P^-1)^-1`, P the diagonal of unknown_variances. Directions that rounding hides beside
/// the largest variance count as unknown.
Matrix6d bounded_covariance(const Matrix6d& covariance);

/// The covariance of the mean of n poses with independent errors: the sum over n^2; of each degree
/// of freedom the word of the scene that holds it the least. Throws std::logic_error if there are
/// none.
PoseCovariance covariance_of_mean(const std::vector<PoseCovariance>& covariances);

/// The covariance of a result that several dependent estimates agree on, as estimates from the same
/// data are: their mean, and likewise the words. Throws std::logic_error if there are none.
PoseCovariance mean_covariance(const std::vector<PoseCovariance>& covariances);

}  // namespace croon
