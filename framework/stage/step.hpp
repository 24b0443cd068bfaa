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

/// `Estimate::covariance`, for the data flow of steps that give one or cannot do without.
inline constexpr Extra<PoseCovariance> kCovariance{"covariance", "the covariance of the pose"};

/// A number that a step reports of its work: ("inlier_ratio", 0.83).
using Diagnostic = std::pair<std::string, double>;

/// The estimate of one sensor's pose, passed from step to step of a pipeline.
struct Estimate {
  std::shared_ptr<const Cloud> target;  ///< The reference's cloud, preprocessed so far.
  std::shared_ptr<const Cloud> source;  ///< The sensor's cloud, preprocessed so far.
  RigidTransform T_target_source;
  std::shared_ptr<const GroundSplit> target_ground;  ///< Null until a step has found it.
  std::shared_ptr<const GroundSplit> source_ground;  ///< Null until a step has found it.
  std::optional<Matrix6d> information;               ///< See Registration::information.
  /// Of T_target_source, if a step has estimated it.
  std::optional<PoseCovariance> covariance = std::nullopt;
  std::optional<std::string> rejection;  ///< Why the pose must not be trusted, if so.
  std::vector<Diagnostic> diagnostics;   ///< What the last step reports of its work.
  Extras extras;                         ///< What steps put here for later ones.

  /// Moves the pose to `T`. The information and the covariance of another pose go: a step sets
  /// those of the new pose afterwards.
  void set_pose(const RigidTransform& T) {
    const bool is_moved =
        T.rotation != T_target_source.rotation || T.translation != T_target_source.translation;
    T_target_source = T;
    if (!is_moved) return;
    information.reset();
    covariance.reset();
  }

  /// Goes on with other clouds. The grounds that were found are those of the clouds before.
  void take_clouds(std::shared_ptr<const Cloud> new_target,
                   std::shared_ptr<const Cloud> new_source) {
    target = std::move(new_target);
    source = std::move(new_source);
    target_ground = nullptr;
    source_ground = nullptr;
  }

  /// The axis of yaw: the normal of the target's ground, or z if the ground is not known.
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

  /// The better estimate. Draws only from `rng`. Throws StageError if the data defeat it.
  virtual Estimate advance(Estimate estimate, Rng& rng) const = 0;
};

}  // namespace croon
