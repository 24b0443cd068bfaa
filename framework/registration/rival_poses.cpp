#include "framework/registration/rival_poses.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/pose_mean.hpp"
#include "framework/registration/pose_evidence.hpp"

namespace croon {
namespace {

constexpr double kShiftStep_m = 0.25;
constexpr std::size_t kMaxima = 5;  // Along each direction.
// Shifts are known to half a step, and a registration from there ends within centimetres.
const PoseBounds kNear = {rad_from_deg(1.0), 1.2 * kShiftStep_m};

/// A pose and its score.
using ScoredPose = std::pair<double, RigidTransform>;

/// The view with every n-th point of its sample.
SensorView with_every(const SensorView& view, std::size_t n) {
  SensorView some = view;
  some.sample.clear();
  for (std::size_t i = 0; i < view.sample.size(); i += n) some.sample.push_back(view.sample[i]);
  return some;
}

/// Adds the outer products of the normals of the points that agree, turned by `R`.
void add_normals(const SensorView& view, const std::vector<Sight>& sights, const Eigen::Matrix3d& R,
                 Eigen::Matrix3d& scatter) {
  const Normals& normals = view.thinned->normals(view.normal_neighbours);
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (sights[i] != Sight::agrees) continue;
    const Eigen::Vector3d normal = R * normals.at(view.sample[i]).normal.cast<double>();
    scatter += normal * normal.transpose();
  }
}

bool is_better(const ScoredPose& a, const ScoredPose& b) { return a.first > b.first; }

/// The best shifted poses at which the score has a local maximum. There is no bound for their
/// scores: if the direction is off by a degree, walls along it miss each other after 10 m.
std::vector<ScoredPose> best_shifts(const SensorView& target, const SensorView& source,
                                    const RigidTransform& T, const Eigen::Vector3d& direction,
                                    double max_shift_m) {
  const int steps = static_cast<int>(max_shift_m / kShiftStep_m);
  std::vector<ScoredPose> shifted;
  for (int step = -steps; step <= steps; ++step) {
    const RigidTransform at{T.rotation, T.translation + kShiftStep_m * step * direction};
    shifted.emplace_back(pose_evidence(target, source, at).score(), at);
  }
  std::vector<ScoredPose> maxima;
  for (std::size_t i = 1; i + 1 < shifted.size(); ++i) {
    const double score = shifted[i].first;
    const RigidTransform& at = shifted[i].second;
    if (agree(at, T, kNear)) continue;
    if (score >= shifted[i - 1].first && score > shifted[i + 1].first) maxima.push_back(shifted[i]);
  }
  std::stable_sort(maxima.begin(), maxima.end(), is_better);
  maxima.resize(std::min(maxima.size(), kMaxima));
  return maxima;
}

}  // namespace

std::vector<RigidTransform> rival_poses(const SensorView& target, const SensorView& source,
                                        const RigidTransform& T_target_source,
                                        const std::vector<RigidTransform>& proposed,
                                        double max_shift_m) {
  constexpr std::size_t kEvery = 8;
  constexpr double kMaxGap = 0.5;
  const SensorView some_target = with_every(target, kEvery);
  const SensorView some_source = with_every(source, kEvery);
  const PoseEvidence evidence = pose_evidence(some_target, some_source, T_target_source);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  add_normals(some_target, evidence.target, Eigen::Matrix3d::Identity(), scatter);
  add_normals(some_source, evidence.source, T_target_source.rotation, scatter);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  std::vector<ScoredPose> found;
  for (const RigidTransform& T : proposed) {
    const double score = pose_evidence(some_target, some_source, T).score();
    if (score >= evidence.score() - kMaxGap) found.emplace_back(score, T);
  }
  for (const int axis : {0, 1}) {
    const Eigen::Vector3d direction = solver.eigenvectors().col(axis);
    for (const ScoredPose& shift :
         best_shifts(some_target, some_source, T_target_source, direction, max_shift_m)) {
      found.push_back(shift);
    }
  }
  std::stable_sort(found.begin(), found.end(), is_better);
  std::vector<RigidTransform> rivals;
  for (const ScoredPose& pose : found) {
    const RigidTransform& T = pose.second;
    const bool is_known =
        agree(T, T_target_source, kNear) ||
        std::any_of(rivals.begin(), rivals.end(),
                    [&](const RigidTransform& other) { return agree(other, T, kNear); });
    if (!is_known) rivals.push_back(T);
  }
  return rivals;
}

std::string difference_in_words(const RigidTransform& rival,
                                const RigidTransform& T_target_source) {
  constexpr double kTurned_deg = 5.0;
  const PoseError apart = pose_error(rival, T_target_source);
  const double turn_deg = deg_from_rad(apart.rotation_rad);
  if (turn_deg > kTurned_deg) return "turned by " + fixed_number(turn_deg, 0) + " degrees";
  const Eigen::Vector3d shift = apart.dof.tail<3>();
  std::string axes;
  for (int i = 0; i < 3; ++i) {
    // An axis is named if the shift is within 60 degrees of it.
    if (std::abs(shift(i)) < 0.5 * apart.translation_m) continue;
    axes += (axes.empty() ? "" : " and ") + std::string(shift(i) < 0.0 ? "-" : "") +
            kDofNames.at(static_cast<std::size_t>(i) + 3);
  }
  return fixed_number(apart.translation_m, 1) + " m further along " + axes;
}

}  // namespace croon
