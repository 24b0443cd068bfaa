#pragma once

#include <functional>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// Cost of a pose; never NaN.
using PoseCost = std::function<double(const RigidTransform&)>;

/// Where a search found the least cost.
struct PoseMinimum {
  RigidTransform pose;
  double cost = 0.0;
  int evaluations = 0;
};

/// Finds the least of a function of pose near a start. Sees a function, never clouds.
class PoseSearch {
 public:
  using Kind = PoseSearch;
  static constexpr const char* kKind = "pose_search";
  static constexpr const char* kKindSummary = "Finds the least of a function of pose near a start.";
  static constexpr int kKindOrder = 70;
  virtual ~PoseSearch() = default;

  /// The pose of least cost near `start`; never one that costs more than `start`.
  virtual PoseMinimum minimise(const PoseCost& cost, const RigidTransform& start) const = 0;
};

}  // namespace croon
