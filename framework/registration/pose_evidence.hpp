#pragma once

#include "framework/geometry/rigid_transform.hpp"
#include "framework/registration/sensor_view.hpp"

namespace croon {

/// When points agree, and when they contradict.
struct EvidenceOptions {
  double max_distance_m = 0.5;        ///< To the nearest point of the other cloud.
  double max_plane_distance_m = 0.1;  ///< To the plane through it.
  double max_normal_angle_deg = 30.0;
  double range_margin_m = 0.4;  ///< Ranges agree that differ by at most this.
  double range_ratio = 0.02;    ///< So do those that differ by at most this share of them.
};

/// Numbers of points of one cloud's sample, as the other sensor sees them at a pose.
struct OneWayEvidence {
  int points = 0;    ///< Of the sample.
  int agree = 0;     ///< On a surface of the other cloud, with its normal.
  int disagree = 0;  ///< Where the other sensor sees, but on no surface of its cloud.
  int violate = 0;   ///< In front of all that the other sensor sees in that direction.
  int hidden = 0;    ///< Behind what the other sensor sees.
  int unseen = 0;    ///< In a direction without a return.
};

/// Evidence for or against a pose that is not the cost that registrations minimise.
struct PoseEvidence {
  OneWayEvidence source;  ///< The source's points in the target's view.
  OneWayEvidence target;  ///< The target's points in the source's view.

  /// Agreeing over visible points, both ways; 0 if none is visible.
  double overlap_ratio() const;
  /// Points in free space over visible points, both ways; 0 if none is visible.
  double violation_ratio() const;
  /// What hypotheses are compared by, from -4 to 2: the sum over both ways of
  /// `(2 agree - disagree - 4 violate) / (2 points)`.
  double score() const;
};

/// How well two views agree at the pose `T_target_source`.
PoseEvidence pose_evidence(const SensorView& target, const SensorView& source,
                           const RigidTransform& T_target_source, const EvidenceOptions& options);

}  // namespace croon
