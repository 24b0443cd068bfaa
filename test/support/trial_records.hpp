#pragma once

#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/run/trial_record.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {

using experiments::Status;
using experiments::SuccessBounds;
using experiments::TrialId;
using experiments::TrialRecord;

/// The success bounds of the paper's experiments.
inline constexpr SuccessBounds kBounds = {0.5, 0.1};

/// A trial of (variant, scene, sensor) that ended at `truth` moved by `offset`, with a known truth.
TrialRecord finished(const TrialId& id, Status status, const RigidTransform& truth,
                     const Vector6d& offset);

/// The same without truth.
TrialRecord finished_without_truth(const TrialId& id, const RigidTransform& pose);

/// A trial that did not finish.
TrialRecord unfinished(const TrialId& id, Status status, const std::string& reason);

/// An offset as `moved` takes it, from degrees and metres.
Vector6d offset_of(double roll_deg, double pitch_deg, double yaw_deg, double x_m, double y_m,
                   double z_m);

/// Uniform within +-`rotation_deg` and +-`translation_m` per DOF.
Vector6d random_offset(Rng& rng, double rotation_deg, double translation_m);

/// A few trials of two variants, two sensors and two scenes, of every status, with truth.
std::vector<TrialRecord> few_records();

/// Four trials of one sensor without truth, of which the last is 9 m off.
std::vector<TrialRecord> one_of_four_astray();

/// The records in another order.
std::vector<TrialRecord> shuffled(Rng& rng, std::vector<TrialRecord> records);

}  // namespace croon::test
