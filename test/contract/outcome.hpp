#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/pipeline/rig.hpp"
#include "framework/spatial/cloud.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::test {

/// The result of a stage on two clouds: every number of it, or the StageError.
struct Outcome {
  std::vector<double> numbers;
  std::string stage_error;  ///< The message of the StageError; empty if there was none.

  /// The bits of all numbers and the message: equal texts are equal outcomes.
  std::string bits() const;
  /// True if no number is NaN or infinite.
  bool is_finite() const;
};

/// The two clouds that a stage works on, with their random streams.
struct CloudPair {
  std::shared_ptr<const Cloud> target;
  std::shared_ptr<const Cloud> source;
};

/// The points with the channels that a LiDAR measures.
CloudPair cloud_pair(const Points& target, const Points& source);

/// Builds the stage `json` of `kind` and runs it as its kind asks: on both clouds, on each alone,
/// or on a function. A step runs after `ground_alignment` if that one succeeds. A stage of any
/// other kind runs in the steps that have a slot of the kind; if there is none, throws
/// std::logic_error.
Outcome outcome_of(const std::string& kind, const std::string& json, const CloudPair& clouds);

/// Builds the step `json` and runs it on all members of `rig`, after `ground_alignment`: the
/// numbers of the members that have not failed, and the failures of the others.
Outcome outcome_of_rig(const std::string& json, Rig rig);

}  // namespace croon::test
