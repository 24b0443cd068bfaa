#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/base/rng.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/geometry/plane.hpp"
#include "framework/geometry/pose_covariance.hpp"
#include "framework/spatial/cloud.hpp"
#include "framework/stage/extras.hpp"

namespace croon {

/// The ground plane of a cloud with its normal pointing up, and the points off the ground.
struct GroundSplit {
  Plane plane;                              ///< Normal towards the side of the non-ground points.
  std::shared_ptr<const Cloud> non_ground;  ///< The points off the ground, in the sensor's frame.
};

/// `Estimate::covariance`, for the data flow of steps that provide or require one.
inline constexpr Extra<PoseCovariance> kCovariance{"covariance", "the covariance of the pose"};

/// A number that a step reports about its work: ("inlier_ratio", 0.83).
using Diagnostic = std::pair<std::string, double>;

/// The estimate of one sensor's pose, passed from step to step of a pipeline.
struct Estimate {
  std::shared_ptr<const Cloud>
      target;  ///< The reference's cloud, as preprocessed by earlier steps.
  std::shared_ptr<const Cloud> source;  ///< The sensor's cloud, likewise.
  RigidTransform T_target_source;
  std::shared_ptr<const GroundSplit> target_ground;  ///< Null until a step has found it.
  std::shared_ptr<const GroundSplit> source_ground;  ///< Null until a step has found it.
  std::optional<Matrix6d> information;               ///< See Registration::information.
  /// Of T_target_source, if a step has estimated it.
  std::optional<PoseCovariance> covariance = std::nullopt;
  std::optional<std::string> rejection;  ///< The reason if the pose is rejected.
  std::vector<Diagnostic> diagnostics;   ///< Reported by the last step.
  Extras extras;                         ///< Values that steps provide for later ones.
  RigidTransform initial_guess = {};     ///< T_target_source before the first step.

  /// Sets the pose to `T`. If it differs, information and covariance of the old pose are reset; a
  /// step sets those of the new pose afterwards.
  void set_pose(const RigidTransform& T) {
    const bool is_moved = T != T_target_source;
    T_target_source = T;
    if (!is_moved) return;
    information.reset();
    covariance.reset();
  }

  /// Replaces the clouds, and resets the grounds, which belong to the old clouds.
  void take_clouds(std::shared_ptr<const Cloud> new_target,
                   std::shared_ptr<const Cloud> new_source) {
    target = std::move(new_target);
    source = std::move(new_source);
    target_ground = nullptr;
    source_ground = nullptr;
  }

  /// The axis of yaw: the normal of the target's ground, or z if the ground is unknown.
  Eigen::Vector3d up() const {
    return target_ground ? target_ground->plane.normal : Eigen::Vector3d::UnitZ();
  }
};

/// An element of a pipeline: takes an estimate and returns a better one.
class Step {
 public:
  using Kind = Step;
  static constexpr const char* kKind = "step";
  static constexpr const char* kKindSummary =
      "An element of the pipeline: takes an estimate and returns a better one.";
  static constexpr int kKindOrder = 80;
  virtual ~Step() = default;

  /// Returns the improved estimate. Draws only from `rng`. Throws StageError if the data defeat it.
  virtual Estimate advance(Estimate estimate, Rng& rng) const = 0;
};

}  // namespace croon
