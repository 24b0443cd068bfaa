#pragma once

#include <optional>

#include "framework/registration/joint_registration.hpp"

namespace croon {

/// Alternative starts for the registration of one scene, derived from `state`: with the speed along
/// `axis` (a unit vector in the target's frame), including what an earlier step has removed, set to
/// each of `speeds_mps`. The sensors move by the distance that the rig travels between the target's
/// scan and theirs, so that the clouds still match approximately.
std::vector<JointState> other_speeds(const JointScene& scene, const JointState& state,
                                     const Eigen::Vector3d& axis,
                                     const std::vector<double>& speeds_mps,
                                     const JointOptions& options);

/// In a rival of a state, a sensor is farther than this from its position in the state.
inline constexpr double kRivalDistance_m = 0.05;

/// The lead, in standard deviations, of the agreement of all points (see PairAgreement) in `state`
/// of one scene over that in its rivals. The rivals are the results of registrations that start at
/// `starts`, first with `coarse_options` on the thinned scene `coarse`, then with `options` on
/// `scene`. For each source, the minimum lead over the rivals in which its position differs;
/// std::nullopt if there are none; negative if a rival agrees better. Surfaces are weighted by how
/// much they face along the axis in which the two velocities differ.
///
/// The difference is a sum over cubes of space, which count as independent: its variance is the sum
/// of their squares. So a rival that only a few moving cars support has a small lead or deficit.
std::vector<std::optional<double>> leads_over_rivals(const JointScene& scene,
                                                     const JointScene& coarse,
                                                     const JointState& state,
                                                     const std::vector<JointState>& starts,
                                                     const JointOptions& options,
                                                     const JointOptions& coarse_options);

}  // namespace croon
