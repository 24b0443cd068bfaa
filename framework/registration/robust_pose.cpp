#include "framework/registration/robust_pose.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"

namespace croon {
namespace {

using Vectors = std::vector<Eigen::Vector3d>;

/// The rotation with the minimum sum of `weights[i] |target[i] - R source[i]|^2`.
Eigen::Matrix3d weighted_rotation(const Vectors& target, const Vectors& source,
                                  const std::vector<double>& weights) {
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < target.size(); ++i) {
    products.noalias() += weights[i] * target[i] * source[i].transpose();
  }
  const Eigen::Vector3d values = Eigen::JacobiSVD<Eigen::Matrix3d>(products).singularValues();
  if (!(values(1) > 1e-6 * values(0))) {
    throw StageError("the correspondences that agree lie on one line");
  }
  return nearest_rotation(products);
}

std::vector<double> squared_residuals(const Vectors& target, const Vectors& source,
                                      const Eigen::Matrix3d& R) {
  std::vector<double> residuals;
  for (std::size_t i = 0; i < target.size(); ++i) {
    residuals.push_back((target[i] - R * source[i]).squaredNorm());
  }
  return residuals;
}

/// The weight of a residual in the surrogate of truncated least squares with the control `mu`
/// (equation 14 of Yang et al. 2020).
double surrogate_weight(double squared_residual, double squared_bound, double mu) {
  if (squared_residual >= (mu + 1.0) / mu * squared_bound) return 0.0;
  if (squared_residual <= mu / (mu + 1.0) * squared_bound) return 1.0;
  return std::sqrt(squared_bound / squared_residual * mu * (mu + 1.0)) - mu;
}

/// The rotation R that minimises the truncated squares of `target[i] - R source[i]` (lengths in m;
/// residuals beyond `bound_m` count as `bound_m`), by graduated non-convexity (Yang, Antonante,
/// Tzoumas and Carlone, RA-L 2020) around the closed form of Horn and Arun (weighted singular value
/// decomposition).
Eigen::Matrix3d robust_rotation(const Vectors& target, const Vectors& source, double bound_m) {
  constexpr double kGrowth = 1.4;  // Of the control, per round (Yang et al. 2020).
  constexpr int kMaxRounds = 100;
  std::vector<double> weights(target.size(), 1.0);
  if (target.size() < 2) throw StageError("fewer than two vectors do not determine a rotation");
  Eigen::Matrix3d R = weighted_rotation(target, source, weights);
  std::vector<double> residuals = squared_residuals(target, source, R);
  const double bound_m2 = bound_m * bound_m;
  const double largest = *std::max_element(residuals.begin(), residuals.end());
  if (!(2.0 * largest > bound_m2)) return R;
  double mu = bound_m2 / (2.0 * largest - bound_m2);
  for (int round = 0; round < kMaxRounds; ++round, mu *= kGrowth) {
    bool is_binary = true;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      weights[i] = surrogate_weight(residuals[i], bound_m2, mu);
      is_binary = is_binary && (weights[i] == 0.0 || weights[i] == 1.0);
    }
    R = weighted_rotation(target, source, weights);
    if (is_binary) break;
    residuals = squared_residuals(target, source, R);
  }
  return R;
}

}  // namespace

double most_voted(std::vector<double> values, double bound) {
  std::sort(values.begin(), values.end());
  std::size_t first = 0;
  std::size_t most = 0;
  double best = 0.0;
  double sum = 0.0;
  for (std::size_t last = 0; last < values.size(); ++last) {
    sum += values[last];
    // A number is within the bound of all of them if their range is at most twice the bound.
    while (values[last] - values[first] > 2.0 * bound) sum -= values[first++];
    const std::size_t count = last - first + 1;
    if (count > most) {
      most = count;
      best = sum / static_cast<double>(count);
    }
  }
  return best;
}

RigidTransform robust_pose(const Points& target, const Points& source, double bound_m) {
  constexpr std::size_t kPairs = 2000;  // Of all differences, evenly spaced.
  const std::size_t count = target.size();
  const std::size_t all = count * (count > 0 ? count - 1 : 0) / 2;
  const std::size_t stride = std::max<std::size_t>(1, all / kPairs);
  Vectors target_differences;
  Vectors source_differences;
  std::size_t number = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      if (number++ % stride != 0) continue;
      target_differences.push_back((target[j] - target[i]).cast<double>());
      source_differences.push_back((source[j] - source[i]).cast<double>());
    }
  }
  RigidTransform T;
  // Both ends of a difference may be off by the bound.
  T.rotation = robust_rotation(target_differences, source_differences, 2.0 * bound_m);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> votes;
    for (std::size_t i = 0; i < count; ++i) {
      votes.push_back((target[i].cast<double>() - T.rotation * source[i].cast<double>())(axis));
    }
    T.translation(axis) = most_voted(std::move(votes), bound_m);
  }
  return T;
}

}  // namespace croon
