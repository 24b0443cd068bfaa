#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/base/rng.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/geometry/plane.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// The ground of a cloud, turned so that its normal points up, and what stands on it.
struct GroundSplit {
  Plane plane;                              ///< Normal towards the side of the non-ground points.
  std::shared_ptr<const Cloud> non_ground;  ///< The points off the ground, in the sensor's frame.
};

/// A number that a step reports of its work: ("inlier_ratio", 0.83).
using StepFigure = std::pair<std::string, double>;

/// What is known of one sensor's pose on its way through the pipeline.
struct Estimate {
  std::shared_ptr<const Cloud> target;  ///< The reference's cloud, preprocessed so far.
  std::shared_ptr<const Cloud> source;  ///< The sensor's cloud, preprocessed so far.
  RigidTransform T_target_source;
  std::shared_ptr<const GroundSplit> target_ground;  ///< Null until a step has found it.
  std::shared_ptr<const GroundSplit> source_ground;  ///< Null until a step has found it.
  std::optional<Matrix6d> information;               ///< See Registration::information.
  std::optional<std::string> rejection;  ///< Why the program says not to trust the pose.
  std::vector<StepFigure> figures;       ///< The last step's report.

  /// The axis that yaw turns about: up from the target's ground, else z.
  Eigen::Vector3d up() const {
    return target_ground ? target_ground->plane.normal : Eigen::Vector3d::UnitZ();
  }
};

/// An element of the pipeline: takes an estimate and returns a better one.
class Step {
 public:
  using Kind = Step;
  static constexpr const char* kKind = "step";
  static constexpr const char* kKindSummary =
      "An element of the pipeline: takes an estimate and returns a better one.";
  static constexpr int kKindOrder = 80;
  virtual ~Step() = default;

  /// The better estimate. Draws only from `rng`. Throws StageError where the data defeat it.
  virtual Estimate advance(Estimate estimate, Rng& rng) const = 0;
};

}  // namespace croon
