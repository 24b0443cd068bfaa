#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/stage/step.hpp"

namespace croon {

/// The estimate of one sensor's pose in one scene of a trial.
struct RigEstimate {
  std::string scene;
  std::string target;  ///< The sensor in whose frame the pose is: the reference, or one of a pair.
  std::string source;  ///< The sensor whose pose is estimated.
  Estimate estimate;
  std::string failure = {};  ///< Empty, or why the step could not go on with this estimate.
  /// The scenes of the trial that have the sensor; in some of them a step may have failed.
  std::size_t scenes = 1;
};

/// A step that sees all scenes and sensors of a trial at once, where other steps see one pair of
/// clouds. It stands in the same pipelines; applied to one pair, it sees a rig of one estimate.
class RigStep : public Step {
 public:
  /// Improves the estimates of a trial in place: those that no step before has failed on, by scene
  /// and then by sensor; their number and order stay. In a rig, unlike on one pair, it sees the
  /// rejections and the information of steps before, and may change them. Draws only from `rng`.
  /// Throws StageError if the data defeat it for all estimates.
  virtual void adjust(std::vector<RigEstimate>& rig, Rng& rng) const = 0;

  /// `adjust` for a rig of one estimate, whose names are empty. Throws StageError if `adjust` does
  /// or sets a failure.
  Estimate advance(Estimate estimate, Rng& rng) const final;
};

/// Throws StageError if a cloud of `estimate` is empty, or has a point that no rig sees: farther
/// off than kLargestCoordinate_m. Steps that put all clouds into one problem call it for each
/// estimate, so that a cloud that would defeat them fails alone.
void require_usable_clouds(const Estimate& estimate);

/// Estimates of a rig that a step treats together, in the order of the rig.
using RigGroup = std::vector<RigEstimate*>;

/// The names that the estimates of a group share: {target, source} for those of one sensor.
using RigKey = std::array<std::string, 2>;

/// The estimates of `rig` in groups of equal `key_of`, by ascending key. An estimate without a key
/// is in no group, nor is one for which `key_of` throws StageError, which becomes its failure.
std::vector<RigGroup> rig_groups(std::vector<RigEstimate>& rig,
                                 const std::function<std::optional<RigKey>(RigEstimate&)>& key_of);

/// Calls `use` for each group, in parallel. A StageError becomes the failure of the estimates of
/// the group that have none.
void for_each_group(const std::vector<RigGroup>& groups,
                    const std::function<void(const RigGroup&)>& use);

}  // namespace croon
