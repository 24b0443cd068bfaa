#pragma once

#include <optional>

#include "framework/registration/joint_registration.hpp"

namespace croon {

/// Other starts for the registration of one scene than `state`: its speed along `axis` (a unit
/// vector in the target's frame), with what a step before has removed, is each of `speeds_mps`. The
/// sensors move by what the rig travels between the target's scan and theirs, so the clouds stay
/// about where they met.
std::vector<JointState> other_speeds(const JointScene& scene, const JointState& state,
                                     const Eigen::Vector3d& axis,
                                     const std::vector<double>& speeds_mps,
                                     const JointOptions& options);

/// A rival of a state has a sensor farther than this from its place there.
inline constexpr double kRivalDistance_m = 0.05;

/// By how many standard deviations the agreement of all points (see PairAgreement) is larger in
/// `state` of one scene than in its rivals: where the registration ends from `starts`, with
/// `coarse_options` on the thinned scene `coarse` and then with `options` on `scene`. Of each
/// source the least of the leads over rivals that have it elsewhere; nothing if none has; negative
/// if one agrees better. Surfaces count by how much they face along the axis in which the two
/// velocities differ.
///
/// The difference is a sum over cubes of space, which count as independent: its variance is the sum
/// of their squares. So a rival that a few moving cars agree with is behind by little, or ahead by
/// little.
std::vector<std::optional<double>> leads_over_rivals(const JointScene& scene,
                                                     const JointScene& coarse,
                                                     const JointState& state,
                                                     const std::vector<JointState>& starts,
                                                     const JointOptions& options,
                                                     const JointOptions& coarse_options);

}  // namespace croon
