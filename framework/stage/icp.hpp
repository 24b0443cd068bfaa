#pragma once

#include "framework/registration/registration.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// Registers a source cloud to a target cloud from a start (paper, refinement).
class Icp {
 public:
  using Kind = Icp;
  static constexpr const char* kKind = "icp";
  static constexpr const char* kKindSummary =
      "Registers a source cloud to a target cloud from a start.";
  static constexpr int kKindOrder = 50;
  virtual ~Icp() = default;

  /// The pose of the source near `start`. Throws StageError for too few correspondences.
  virtual Registration align(const Cloud& target, const Cloud& source,
                             const RigidTransform& start) const = 0;
};

}  // namespace croon
