#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/spatial/cloud.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::test {

/// What a stage made of two clouds: every number of its result, or why it could not go on.
struct Outcome {
  std::vector<double> numbers;
  std::string stage_error;  ///< The StageError's words; empty where there was none.

  /// All numbers, bit by bit, and the words: two outcomes with the same text are the same.
  std::string bits() const;
  /// True where no number is NaN or infinite.
  bool is_finite() const;
};

/// The two clouds that a stage works on, and what it draws for them.
struct CloudPair {
  std::shared_ptr<const Cloud> target;
  std::shared_ptr<const Cloud> source;
};

CloudPair cloud_pair(const PointCloud& target, const PointCloud& source);

/// Builds the stage `json` of `kind` and runs it as its kind asks: on both clouds, on each alone,
/// or on a function. A step runs after `ground_alignment` if that one succeeds. A stage of any
/// other kind runs in the steps that have a slot of the kind; if there is none, throws
/// std::logic_error.
Outcome outcome_of(const std::string& kind, const std::string& json, const CloudPair& clouds);

}  // namespace croon::test
