#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// The volume that two clouds occupy together: the leaves that hold a point of either.
struct OccupiedVolume {
  std::int64_t leaves = 0;
  double leaf_size_m = 0.0;
  double m3() const {
    return static_cast<double>(leaves) * (leaf_size_m * leaf_size_m * leaf_size_m);
  }
};

/// The volume that the target and the source at `T_target_source` occupy in the target's frame.
/// Thread-safe.
using VolumeFunction = std::function<OccupiedVolume(const RigidTransform& T_target_source)>;

/// Measures the alignment of two clouds by the volume that they occupy together (paper, refinement:
/// aligned clouds occupy the least).
class VolumeScorer {
 public:
  using Kind = VolumeScorer;
  static constexpr const char* kKind = "volume_scorer";
  static constexpr const char* kKindSummary =
      "Measures the volume that two clouds occupy together, as a function of pose.";
  static constexpr int kKindOrder = 60;
  virtual ~VolumeScorer() = default;

  /// The volume as a function of pose. What depends on the target alone is computed once
  /// (`Cloud::once`). The leaves are those of LeafGrid in the target's frame, so all scorers count
  /// the same. A cloud without points occupies no leaf. A point outside of the grid throws
  /// StageError: a point of the target here, one of the source in the function.
  virtual VolumeFunction bind(std::shared_ptr<const Cloud> target,
                              std::shared_ptr<const Cloud> source) const = 0;
};

}  // namespace croon
