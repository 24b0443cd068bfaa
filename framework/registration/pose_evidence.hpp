#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/registration/sensor_view.hpp"

namespace croon {

/// The relation of a point of one cloud to the other sensor at a pose.
enum class Sight : std::uint8_t {
  unseen,     ///< In a direction without a return.
  hidden,     ///< Behind what the other sensor sees.
  agrees,     ///< On a surface of the other cloud, with its normal.
  disagrees,  ///< Within the range of the other sensor's returns, but on no surface of its cloud.
  violates,   ///< In front of all returns of the other sensor in that direction.
};

/// Evidence for or against a pose that is independent of the cost that registrations minimise.
struct PoseEvidence {
  std::vector<Sight> source;  ///< Of the source's sample in the target's view, by its points.
  std::vector<Sight> target;  ///< Of the target's sample in the source's view.

  /// Number of agreeing points over visible points, in both directions; 0 if none is visible.
  double overlap_ratio() const;
  /// Points in free space over visible points, in both directions; 0 if none is visible.
  double violation_ratio() const;
  /// The criterion by which hypotheses are compared, from -4 to 2: the sum over both directions of
  /// `(2 agree - disagree - 4 violate) / (2 points)`, in numbers of points.
  double score() const;
};

/// The agreement of two views at the pose `T_target_source`.
PoseEvidence pose_evidence(const SensorView& target, const SensorView& source,
                           const RigidTransform& T_target_source);

/// The lead, in standard deviations, of the evidence for a pose over that for `other`, a pose of
/// the same two views. A point that agrees votes 1 for a pose, one that violates free space -1, and
/// one that disagrees 0. Over the points that are visible at both poses, the sum of the differences
/// between their votes, over the root of the sum of their squares, is approximately standard normal
/// if neither pose fits better (without free space: McNemar, Psychometrika 1947). Points that are
/// visible at only one pose are ignored. std::nullopt if fewer than 40 % of the points visible at
/// the first are also visible at the other, because the two poses are then not comparable.
std::optional<double> lead_over(const PoseEvidence& evidence, const PoseEvidence& other);

}  // namespace croon
