#pragma once

#include <croon/geometry/rigid_transform.hpp>
#include <croon/spatial/cloud.hpp>
#include <croon/stage/extras.hpp>

namespace croon {

/// How much of what the sensor sees the reference sees too, from 0 to 1. overlap_verdict gives it.
inline constexpr Extra<double> kOverlapRatio{"overlap_ratio", "the share of common surface"};

/// Measures the overlap of two clouds at a pose. A kind of stage of this paper.
class OverlapMeasure {
 public:
  using Kind = OverlapMeasure;
  static constexpr const char* kKind = "overlap_measure";
  static constexpr const char* kKindSummary = "Measures the overlap of two clouds at a pose.";
  static constexpr int kKindOrder = 76;
  virtual ~OverlapMeasure() = default;

  /// From 0 to 1; 0 if a cloud has no points.
  virtual double overlap_ratio(const Cloud& target, const Cloud& source,
                               const RigidTransform& T_target_source) const = 0;
};

}  // namespace croon
