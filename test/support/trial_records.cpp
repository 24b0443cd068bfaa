#include "test/support/trial_records.hpp"

#include <utility>

#include "framework/base/angles.hpp"

namespace croon::test {

TrialRecord finished(const TrialId& id, Status status, const RigidTransform& truth,
                     const Vector6d& offset) {
  TrialRecord record = finished_without_truth(id, moved(truth, offset));
  record.status = status;
  record.error = pose_error(*record.T_reference_sensor, truth);
  return record;
}

TrialRecord finished_without_truth(const TrialId& id, const RigidTransform& pose) {
  TrialRecord record;
  record.id = id;
  record.status = Status::finished;
  record.T_reference_sensor = pose;
  return record;
}

TrialRecord unfinished(const TrialId& id, Status status, const std::string& reason) {
  TrialRecord record;
  record.id = id;
  record.status = status;
  record.reason = reason;
  return record;
}

Vector6d offset_of(double roll_deg, double pitch_deg, double yaw_deg, double x_m, double y_m,
                   double z_m) {
  Vector6d offset;
  offset << rad_from_deg(roll_deg), rad_from_deg(pitch_deg), rad_from_deg(yaw_deg), x_m, y_m, z_m;
  return offset;
}

Vector6d random_offset(Rng& rng, double rotation_deg, double translation_m) {
  Vector6d offset;
  for (int k = 0; k < 6; ++k) {
    const double range = k < 3 ? rad_from_deg(rotation_deg) : translation_m;
    offset(k) = rng.uniform(-range, range);
  }
  return offset;
}

std::vector<TrialRecord> few_records() {
  const RigidTransform truth = {Eigen::Matrix3d::Identity(), {1.0, 0.5, -0.25}};
  std::vector<TrialRecord> records;
  for (const char* variant : {"base", "no volume"}) {
    for (const char* scene : {"0001", "0002"}) {
      for (const char* sensor : {"left", "right"}) {
        const double sign = std::string(scene) == "0001" ? 1.0 : -1.0;
        const double size = std::string(variant) == "base" ? 1.0 : 2.0;
        for (int trial = 0; trial < 3; ++trial) {
          const double step = 0.01 * size * trial;
          const Vector6d offset = offset_of(0.02 * sign, -step, step, sign * step, 0.0, 0.003);
          records.push_back(
              finished({variant, scene, sensor, trial}, Status::success, truth, offset));
        }
      }
    }
    records.push_back(finished({variant, "0001", "left", 3}, Status::inaccurate, truth,
                               offset_of(0.0, 0.0, 90.0, 1.0, 0.0, 0.0)));
    records.push_back(unfinished({variant, "0002", "left", 3}, Status::failed,
                                 "ground_alignment: no plane, \"nothing\" is flat"));
  }
  records.push_back(unfinished({"base", "0002", "right", 3}, Status::rejected, "two yaws fit"));
  return records;
}

std::vector<TrialRecord> one_of_four_astray() {
  std::vector<TrialRecord> records;
  for (int trial = 0; trial < 4; ++trial) {
    const RigidTransform pose = {Eigen::Matrix3d::Identity(), {trial == 3 ? 9.0 : 0.0, 0.0, 0.0}};
    records.push_back(finished_without_truth({"base", "0001", "left", trial}, pose));
  }
  return records;
}

std::vector<TrialRecord> shuffled(Rng& rng, std::vector<TrialRecord> records) {
  for (std::size_t i = records.size(); i > 1; --i) std::swap(records[i - 1], records[rng.below(i)]);
  return records;
}

}  // namespace croon::test
