#include "experiments/run/trial_end.hpp"

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/length_bound.hpp"

namespace croon::experiments {
namespace {

bool is_finite(const RigidTransform& T) {
  return T.rotation.allFinite() && T.translation.allFinite();
}

/// Whether the error of the pose and its square are finite.
bool is_near(const RigidTransform& T) {
  return T.translation.cwiseAbs().maxCoeff() <= kLargestDistance_m;
}

/// Completes the record of a trial whose pipeline did not fail.
void finish(TrialRecord& record, const Estimate& estimate,
            const std::optional<RigidTransform>& truth, const SuccessBounds& bounds) {
  if (!is_finite(estimate.T_target_source)) {
    record.reason = "the pose is not finite";
    return;
  }
  if (!is_near(estimate.T_target_source)) {
    record.reason = "the pose is farther away than " + fixed_number(kLargestDistance_m, 0) + " m";
    return;
  }
  if (!is_rotation_matrix(estimate.T_target_source.rotation)) {
    record.reason = "the pose has no rotation: the columns of its matrix are not orthonormal";
    return;
  }
  if (estimate.covariance && !is_covariance(estimate.covariance->matrix)) {
    record.reason =
        "the covariance is none: it is not symmetric, finite and positive semi-definite";
    return;
  }
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
  if (!result.remark.empty()) {
    record.reason += (record.reason.empty() ? "" : "; ") + result.remark;
  }
  return record;
}

}  // namespace croon::experiments
