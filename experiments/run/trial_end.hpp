#pragma once

#include "experiments/file/experiment.hpp"
#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// Whether a pose with this error is right.
bool is_within(const PoseError& error, const SuccessBounds& bounds);

/// The record of the trial `id` with the result `result`, judged by `truth` and `bounds`. A pose
/// that is not finite, too far away for its error to be finite, or not a rotation is a failure, and
/// so is a pose with an invalid covariance.
TrialRecord record_of(const TrialId& id, const PipelineResult& result,
                      const std::optional<RigidTransform>& truth, const SuccessBounds& bounds);

}  // namespace croon::experiments
