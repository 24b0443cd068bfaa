#include "experiments/report/csv_files.hpp"

#include "experiments/file/measures.hpp"
#include "experiments/report/csv_row.hpp"
#include "framework/geometry/rigid_transform.hpp"

namespace croon::experiments {

namespace {

CsvRow row_of(const TrialId& id) {
  CsvRow row;
  row.text(id.variant).text(id.scene).text(id.sensor).count(id.trial);
  return row;
}

void add_error(CsvRow& row, const std::optional<PoseError>& error) {
  if (!error) {
    row.empty(static_cast<int>(kMeasures.size()));
    return;
  }
  const Measures measures = measures_of(*error);
  // The two distances first, then the DOFs.
  for (std::size_t k = kDofs; k < kMeasures.size(); ++k) row.number(measures[k]);
  for (std::size_t k = 0; k < kDofs; ++k) row.number(measures[k]);
}

void add_pose(CsvRow& row, const std::optional<RigidTransform>& pose) {
  if (!pose) {
    row.empty(7);
    return;
  }
  for (const double value : pose->translation) row.number(value);
  const Eigen::Quaterniond q = unit_quaternion(pose->rotation);
  for (const double value : q.coeffs()) row.number(value);
}

}  // namespace

std::string trials_csv(const std::vector<TrialRecord>& records) {
  std::string bytes =
      "variant,scene,sensor,trial,status,rotation_error_deg,translation_error_m,roll_error_deg,"
      "pitch_error_deg,yaw_error_deg,x_error_m,y_error_m,z_error_m,tx_m,ty_m,tz_m,qx,qy,qz,qw\n";
  for (const TrialRecord& record : records) {
    CsvRow row = row_of(record.id);
    row.text(status_name(record.status));
    add_error(row, record.error);
    add_pose(row, record.T_reference_sensor);
    bytes += row.line();
  }
  return bytes;
}

std::string timings_csv(const std::vector<TimingRow>& rows) {
  std::string bytes = "variant,scene,sensor,trial,step,seconds\n";
  for (const TimingRow& timing : rows) {
    bytes += row_of(timing.id).text(timing.step).number(timing.seconds).line();
  }
  return bytes;
}

}  // namespace croon::experiments
