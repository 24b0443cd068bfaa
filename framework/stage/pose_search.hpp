#pragma once

#include <functional>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// Cost of a pose; never NaN.
using PoseCost = std::function<double(const RigidTransform&)>;

/// The pose of least cost that a search found.
struct PoseMinimum {
  RigidTransform pose;
  double cost = 0.0;
  int evaluations = 0;
};

/// Minimises a function of pose near a start. It never sees clouds.
class PoseSearch {
 public:
  using Kind = PoseSearch;
  static constexpr const char* kKind = "pose_search";
  static constexpr const char* kKindSummary = "Minimises a function of pose near a start.";
  static constexpr int kKindOrder = 70;
  virtual ~PoseSearch() = default;

  /// The pose of least cost near `start`; its cost is never higher than that of `start`.
  virtual PoseMinimum minimise(const PoseCost& cost, const RigidTransform& start) const = 0;
};

}  // namespace croon
