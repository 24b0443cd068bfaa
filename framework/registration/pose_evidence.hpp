#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/registration/sensor_view.hpp"

namespace croon {

/// What a point of one cloud is to the other sensor at a pose.
enum class Sight : std::uint8_t {
  unseen,     ///< In a direction without a return.
  hidden,     ///< Behind what the other sensor sees.
  agrees,     ///< On a surface of the other cloud, with its normal.
  disagrees,  ///< Where the other sensor sees, but on no surface of its cloud.
  violates,   ///< In front of all that the other sensor sees in that direction.
};

/// Evidence for or against a pose that is not the cost that registrations minimise.
struct PoseEvidence {
  std::vector<Sight> source;  ///< Of the source's sample in the target's view, by its points.
  std::vector<Sight> target;  ///< Of the target's sample in the source's view.

  /// Agreeing over visible points, both ways; 0 if none is visible.
  double overlap_ratio() const;
  /// Points in free space over visible points, both ways; 0 if none is visible.
  double violation_ratio() const;
  /// What hypotheses are compared by, from -4 to 2: the sum over both ways of
  /// `(2 agree - disagree - 4 violate) / (2 points)`, as numbers of points.
  double score() const;
};

/// How well two views agree at the pose `T_target_source`.
PoseEvidence pose_evidence(const SensorView& target, const SensorView& source,
                           const RigidTransform& T_target_source);

/// By how many standard deviations the evidence for a pose is better than for `other`, a pose of
/// the same two views: of the points that are visible at both poses a agree at the first alone and
/// b at the other alone, and `(a - b) / sqrt(a + b)` is about standard normal if neither fits
/// better (McNemar, Psychometrika 1947). Points that are visible at one pose alone do not count.
/// Nothing if fewer than half of the points that are visible at the first are at the other as well:
/// then the two cannot be compared.
std::optional<double> lead_over(const PoseEvidence& evidence, const PoseEvidence& other);

}  // namespace croon
