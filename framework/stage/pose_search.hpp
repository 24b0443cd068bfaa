#pragma once

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// Cost function of a pose; never NaN.
class PoseCost {
 public:
  using OfPose = std::function<double(const RigidTransform&)>;
  using OfPoses = std::function<std::vector<double>(const std::vector<RigidTransform>&)>;

  /// From a function of one pose, and one of many poses that returns the same costs and may use
  /// threads. Without the latter they are computed sequentially.
  template <class Function, class = std::enable_if_t<std::is_invocable_r_v<double, const Function&,
                                                                           const RigidTransform&>>>
  // Implicit on purpose: callables convert.
  PoseCost(Function of_pose, OfPoses of_poses = {})  // NOLINT(*-explicit-*)
      : of_pose_(std::move(of_pose)), of_poses_(std::move(of_poses)) {}

  double operator()(const RigidTransform& pose) const { return of_pose_(pose); }

  /// The costs of several poses, in their order.
  std::vector<double> at(const std::vector<RigidTransform>& poses) const {
    if (of_poses_) return of_poses_(poses);
    std::vector<double> costs;
    for (const RigidTransform& pose : poses) costs.push_back(of_pose_(pose));
    return costs;
  }

 private:
  OfPose of_pose_;
  OfPoses of_poses_;
};

/// The pose of minimum cost that a search found.
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

  /// The pose of minimum cost near `start`; its cost is never higher than that of `start`.
  virtual PoseMinimum minimise(const PoseCost& cost, const RigidTransform& start) const = 0;
};

}  // namespace croon
