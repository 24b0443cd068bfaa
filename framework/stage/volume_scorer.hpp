#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/spatial/cloud.hpp"
#include "framework/stage/pose_search.hpp"

namespace croon {

/// The volume that two clouds occupy together.
struct OccupiedVolume {
  double m3 = 0.0;
  std::int64_t leaves = 0;  ///< Number of leaves counted, over all lattices.

  /// The volume of leaves of one size.
  static OccupiedVolume of_leaves(std::int64_t leaves, double leaf_size_m) {
    return {static_cast<double>(leaves) * (leaf_size_m * leaf_size_m * leaf_size_m), leaves};
  }
};

/// How a VolumeFunction computes a list of poses.
enum class Poses { one_by_one, in_parallel };

/// The volume that the target and the source at `T_target_source` occupy in the target's frame.
/// Thread-safe.
class VolumeFunction {
 public:
  using OfPose = std::function<OccupiedVolume(const RigidTransform& T_target_source)>;

  VolumeFunction() = default;
  /// From a function of one pose; `poses` selects whether lists of poses are computed in parallel.
  template <class Function, class = std::enable_if_t<std::is_invocable_r_v<
                                OccupiedVolume, const Function&, const RigidTransform&>>>
  // Implicit on purpose: callables convert.
  VolumeFunction(Function of_pose, Poses poses = Poses::one_by_one)  // NOLINT(*-explicit-*)
      : of_pose_(std::move(of_pose)), poses_(poses) {}

  OccupiedVolume operator()(const RigidTransform& T_target_source) const {
    return of_pose_(T_target_source);
  }

  /// The volumes at several poses, in their order. Uses the threads available to the caller's trial
  /// (TBB's), and starts no other work while waiting. The same bits as for one pose after the
  /// other.
  std::vector<OccupiedVolume> at(const std::vector<RigidTransform>& poses) const;

 private:
  OfPose of_pose_;
  Poses poses_ = Poses::one_by_one;
};

/// The volume in cubic metres as a cost function. Keeps a copy of `volume`.
PoseCost volume_cost(const VolumeFunction& volume);

/// Measures the alignment of two clouds by the volume that they occupy together (paper, refinement:
/// it is minimal for aligned clouds).
class VolumeScorer {
 public:
  using Kind = VolumeScorer;
  static constexpr const char* kKind = "volume_scorer";
  static constexpr const char* kKindSummary =
      "Measures the volume that two clouds occupy together, as a function of pose.";
  static constexpr int kKindOrder = 60;
  virtual ~VolumeScorer() = default;

  /// The volume as a function of pose. Everything that depends only on the target is computed once
  /// (`Cloud::once`). A cloud without points occupies no volume. Scorers that count leaves derive
  /// from LeafScorer.
  virtual VolumeFunction bind(std::shared_ptr<const Cloud> target,
                              std::shared_ptr<const Cloud> source) const = 0;
};

}  // namespace croon
