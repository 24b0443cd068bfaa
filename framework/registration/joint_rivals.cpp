#include "framework/registration/joint_rivals.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/base/threads.hpp"
#include "framework/registration/joint_pair.hpp"

namespace croon {
namespace {

/// The agreement of each source of a scene in `state`.
std::vector<PairAgreement> agreements_in(const JointScene& scene, const JointState& state,
                                         const JointOptions& options) {
  const Twist& velocity = state.velocities.front();
  const DeskewedTarget target(scene, velocity, options);
  std::vector<PairAgreement> pairs;
  for (const JointScene::Source& source : scene.sources) {
    pairs.push_back(pair_agreement(source, target, last_view(state, velocity, options)));
  }
  return pairs;
}

using Agreement = std::map<JointCell, double>;

/// The sums over all sources with enough correspondences.
Agreement sum_by_cell(const std::vector<PairAgreement>& pairs,
                      const std::optional<Eigen::Vector3d>& axis) {
  Agreement agreement;
  for (const PairAgreement& pair : pairs) {
    if (pair.points.size() < kMinJointCorrespondences) continue;
    for (const auto& [cell, agreeing] : pair.by_cell(axis)) agreement[cell] += agreeing;
  }
  return agreement;
}

double sum_of(const Agreement& agreement) {
  double sum = 0.0;
  for (const auto& [cell, agreeing] : agreement) sum += agreeing;
  return sum;
}

/// The horizontal axis along which the velocities of two states differ; std::nullopt if they do
/// not.
std::optional<Eigen::Vector3d> axis_between(const JointState& a, const JointState& b) {
  Eigen::Vector3d apart_mps = a.velocities.front().linear_mps - b.velocities.front().linear_mps;
  apart_mps.z() = 0.0;
  if (apart_mps.isZero(0.0)) return std::nullopt;
  return apart_mps.normalized();
}

/// The lead of `a` over `b` in standard deviations; 0 if they agree in every cube.
double lead_of(const Agreement& a, const Agreement& b) {
  Agreement differences = a;
  for (const auto& [cell, agreeing] : b) differences[cell] -= agreeing;
  double squares = 0.0;
  for (const auto& [cell, difference] : differences) squares += difference * difference;
  return squares > 0.0 ? sum_of(differences) / std::sqrt(squares) : 0.0;
}

/// Whether the position of a sensor differs between two states.
bool is_elsewhere(const JointState& a, const JointState& b, std::size_t sensor) {
  const Eigen::Vector3d apart_m =
      a.T_target_sensor[sensor].translation - b.T_target_sensor[sensor].translation;
  return apart_m.norm() > kRivalDistance_m;
}

bool is_rival(const JointState& a, const JointState& b) {
  for (std::size_t k = 0; k < a.T_target_sensor.size(); ++k) {
    if (is_elsewhere(a, b, k)) return true;
  }
  return false;
}

/// The results of the registration of `scenes` from each of `starts`, computed in parallel.
std::vector<JointState> registered(const std::vector<JointScene>& scenes,
                                   const std::vector<JointState>& starts,
                                   const JointOptions& options) {
  std::vector<JointState> ends(starts.size());
  for_each_in_parallel(starts.size(), [&](std::size_t i) {
    ends[i] = register_jointly(scenes, starts[i], options).state;
  });
  return ends;
}

/// Those of `states` that are rivals of `state` and of each other; of several similar ones, the
/// first.
std::vector<JointState> different_from(const JointState& state,
                                       const std::vector<JointState>& states) {
  std::vector<JointState> seen = {state};
  for (const JointState& other : states) {
    const bool is_new = std::all_of(seen.begin(), seen.end(),
                                    [&](const JointState& one) { return is_rival(one, other); });
    if (is_new) seen.push_back(other);
  }
  seen.erase(seen.begin());
  return seen;
}

}  // namespace

std::vector<JointState> other_speeds(const JointScene& scene, const JointState& state,
                                     const Eigen::Vector3d& axis,
                                     const std::vector<double>& speeds_mps,
                                     const JointOptions& options) {
  const double speed_now_mps =
      (scene.removed.linear_mps + state.velocities.front().linear_mps).dot(axis);
  std::vector<double> later_s(state.T_target_sensor.size(), 0.0);
  const std::vector<PairAgreement> pairs = agreements_in(scene, state, options);
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    later_s[scene.sources[j].sensor] = pairs[j].later_s;
  }
  std::vector<JointState> others;
  for (const double speed_mps : speeds_mps) {
    const Eigen::Vector3d change_mps = (speed_mps - speed_now_mps) * axis;
    JointState other = state;
    other.velocities.front().linear_mps += change_mps;
    for (std::size_t k = 0; k < later_s.size(); ++k) {
      other.T_target_sensor[k].translation -= later_s[k] * change_mps;
    }
    others.push_back(std::move(other));
  }
  return others;
}

std::vector<std::optional<double>> leads_over_rivals(const JointScene& scene,
                                                     const JointScene& coarse,
                                                     const JointState& state,
                                                     const std::vector<JointState>& starts,
                                                     const JointOptions& options,
                                                     const JointOptions& coarse_options) {
  // More points tell closer rivals apart, and are needed only once for each.
  constexpr int kMore = 4;
  JointOptions compared = options;
  compared.points = kMore * options.points;
  const std::vector<PairAgreement> own = agreements_in(scene, state, compared);
  std::vector<std::optional<double>> min_leads(scene.sources.size());
  // Most starts converge to the same few states, so those that others reach go on alone.
  std::vector<JointState> near = starts;
  JointOptions pass = coarse_options;
  pass.step_tolerance.back() = pass.step_tolerance.front();
  for (const double distance_m : coarse_options.max_distances_m) {
    pass.max_distances_m = {distance_m};
    near = different_from(state, registered({coarse}, near, pass));
  }
  for (const JointState& fine : registered({scene}, near, options)) {
    if (!is_rival(fine, state)) continue;
    const std::optional<Eigen::Vector3d> axis = axis_between(state, fine);
    const double lead =
        lead_of(sum_by_cell(own, axis), sum_by_cell(agreements_in(scene, fine, compared), axis));
    for (std::size_t j = 0; j < min_leads.size(); ++j) {
      if (!is_elsewhere(fine, state, scene.sources[j].sensor)) continue;
      min_leads[j] = std::min(lead, min_leads[j].value_or(lead));
    }
  }
  return min_leads;
}

}  // namespace croon
