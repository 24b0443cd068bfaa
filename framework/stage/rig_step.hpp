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
  /// Empty, or why this step, or for a step with `sees_failures` an earlier one, could not process
  /// this estimate.
  std::string failure = {};
  /// The number of scenes of the trial with this sensor, including those in which a step failed.
  std::size_t scenes = 1;
};

/// A step that processes all scenes and sensors of a trial at once, whereas other steps process one
/// pair of clouds. Both can be in the same pipeline; for a single pair, the rig has one estimate.
class RigStep : public Step {
 public:
  /// Improves the estimates of a trial in place: those for which no earlier step has failed, by
  /// scene and then by sensor; their number and order must not change. In a rig, unlike for a
  /// single pair, the step sees the rejections and the information of earlier steps and may change
  /// them. Draws only from `rng`. Throws StageError if the data defeat it for all estimates.
  virtual void adjust(std::vector<RigEstimate>& rig, Rng& rng) const = 0;

  /// Whether `adjust` also receives the estimates for which an earlier step has failed, as they
  /// were before that step and with its failure, if they have both clouds. It may clear the failure
  /// of those that it can repair, and add to that of others.
  virtual bool sees_failures() const { return false; }

  /// `adjust` for a rig of one estimate with empty names. Throws StageError if `adjust` does or if
  /// it sets a failure.
  Estimate advance(Estimate estimate, Rng& rng) const final;
};

/// Throws StageError if a cloud of `estimate` is empty, or has a point beyond kMaxCoordinate_m.
/// Steps that combine all clouds into one problem call it for each estimate, so that only the
/// estimate of an unusable cloud fails.
void require_usable_clouds(const Estimate& estimate);

/// Estimates of a rig that a step treats together, in the order of the rig.
using RigGroup = std::vector<RigEstimate*>;

/// The names that the estimates of a group share: {target, source} for those of one sensor.
using RigKey = std::array<std::string, 2>;

/// Groups the estimates of `rig` by equal `key_of`, in order of the keys. Estimates without a key
/// are omitted, as are those for which `key_of` throws StageError, which becomes their failure.
std::vector<RigGroup> rig_groups(std::vector<RigEstimate>& rig,
                                 const std::function<std::optional<RigKey>(RigEstimate&)>& key_of);

/// Calls `use` for each group, in parallel. A StageError becomes the failure of those estimates of
/// the group that have no failure yet.
void for_each_group(const std::vector<RigGroup>& groups,
                    const std::function<void(const RigGroup&)>& use);

}  // namespace croon
