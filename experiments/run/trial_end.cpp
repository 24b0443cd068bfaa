#include "experiments/run/trial_end.hpp"

#include "framework/base/angles.hpp"
#include "framework/calibration/rig_run.hpp"

namespace croon::experiments {
namespace {

/// Completes the record of a trial whose pipeline did not fail.
void finish(TrialRecord& record, const Estimate& estimate,
            const std::optional<RigidTransform>& truth, const SuccessBounds& bounds) {
  record.reason = why_unusable(estimate);
  if (!record.reason.empty()) return;
  record.T_reference_sensor = estimate.T_target_source;
  record.covariance = estimate.covariance;
  if (truth) record.error = pose_error(estimate.T_target_source, *truth);
  record.status = Status::finished;
  if (record.error) {
    record.status = is_within(*record.error, bounds) ? Status::success : Status::inaccurate;
  }
  if (estimate.rejection) {
    record.status = Status::rejected;
    record.reason = *estimate.rejection;
  }
}

}  // namespace

bool is_within(const PoseError& error, const SuccessBounds& bounds) {
  return error.rotation_rad <= rad_from_deg(bounds.rotation_deg) &&
         error.translation_m <= bounds.translation_m;
}

TrialRecord record_of(const TrialId& id, const PipelineResult& result,
                      const std::optional<RigidTransform>& truth, const SuccessBounds& bounds) {
  TrialRecord record;
  record.id = id;
  record.status = Status::failed;
  record.reason = result.failure;
  record.steps = result.records;
  if (result.failure.empty()) finish(record, result.estimate, truth, bounds);
  if (!result.note.empty()) {
    record.reason += (record.reason.empty() ? "" : "; ") + result.note;
  }
  return record;
}

}  // namespace croon::experiments
