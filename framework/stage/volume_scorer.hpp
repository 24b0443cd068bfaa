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
  std::int64_t leaves = 0;  ///< How many were counted for it, over all lattices.

  /// That of leaves of one size.
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
  /// From a function of one pose. Lists of poses are computed by tasks of their own if it says so.
  template <class Function, class = std::enable_if_t<std::is_invocable_r_v<
                                OccupiedVolume, const Function&, const RigidTransform&>>>
  // A function is converted where one is expected.
  VolumeFunction(Function of_pose, Poses poses = Poses::one_by_one)  // NOLINT(*-explicit-*)
      : of_pose_(std::move(of_pose)), poses_(poses) {}

  OccupiedVolume operator()(const RigidTransform& T_target_source) const {
    return of_pose_(T_target_source);
  }

  /// The volumes at many poses, in their order. Uses the threads that the caller's trial may use
  /// (TBB's), and takes up no other work while it waits. The bits are those of one pose after the
  /// other.
  std::vector<OccupiedVolume> at(const std::vector<RigidTransform>& poses) const;

 private:
  OfPose of_pose_;
  Poses poses_ = Poses::one_by_one;
};

/// The volume in cubic metres as the cost of a search. Keeps a copy of `volume`.
PoseCost volume_cost(const VolumeFunction& volume);

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
  /// (`Cloud::once`). A cloud without points occupies nothing. A scorer that counts leaves derives
  /// from LeafScorer.
  virtual VolumeFunction bind(std::shared_ptr<const Cloud> target,
                              std::shared_ptr<const Cloud> source) const = 0;
};

}  // namespace croon
