#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

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
