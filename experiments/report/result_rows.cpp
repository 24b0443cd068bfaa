#include "experiments/report/result_tables.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {
namespace {

/// The columns of diagnostics.csv; both arguments must outlive them.
Columns<StepNumber> step_number_columns(const std::vector<TrialRecord>& records,
                                        const StepNumbers& steps) {
  using N = StepNumber;
  Columns<N> columns;
  columns
      .add(id_columns(),
           [&](const N& number) -> const TrialId& { return records[number.record].id; })
      .add({"step"}, [&](const N& number) { return steps.names[number.step]; })
      .add({"name"}, [&](const N& number) { return steps.names[number.name]; })
      .add({"value"}, &N::value);
  return columns;
}

/// The columns of covariance.csv.
Columns<TrialRecord> covariance_row_columns() {
  Columns<TrialRecord> columns;
  columns.add(id_columns(), &TrialRecord::id);
  return columns.add(covariance_columns(), &TrialRecord::covariance);
}

}  // namespace

Columns<TrialId> id_columns() {
  Columns<TrialId> columns;
  return columns.add({"variant"}, &TrialId::variant)
      .add({"scene"}, &TrialId::scene)
      .add({"sensor"}, &TrialId::sensor)
      .add({"trial"}, &TrialId::trial);
}

Columns<PoseCovariance> covariance_columns(const std::string& path) {
  using C = PoseCovariance;
  Columns<C> columns;
  for (int i = 0; i < 6; ++i) {
    // JSON has both triangles, so that readers need not know which one is stored.
    for (int j = path.empty() ? i : 0; j < 6; ++j) {
      const std::string index = std::to_string(i) + "/" + std::to_string(j);
      columns.add({"c" + std::to_string(i) + std::to_string(j), "",
                   path + "/roll_pitch_yaw_rad_x_y_z_m/" + index, kAllDigits},
                  [=](const C& covariance) { return covariance.matrix(i, j); });
    }
  }
  for (std::size_t i = 0; i < kDofNames.size(); ++i) {
    columns.add({kDofNames[i], "", path + "/" + kDofNames[i]},
                [i](const C& covariance) { return name_of(covariance.dofs[i]); });
  }
  return columns;
}

std::vector<Column> covariance_rows(const std::vector<TrialRecord>& records, const RowUse& use) {
  const Columns<TrialRecord> columns = covariance_row_columns();
  for (const TrialRecord& record : records) {
    if (record.covariance) use(columns.cells(record));
  }
  return columns.columns();
}

std::vector<Column> comparison_rows(const Summary& summary, const RowUse& use) {
  return use_rows(comparison_columns(), summary.comparisons, use);
}

std::vector<Column> diagnostic_rows(const std::vector<TrialRecord>& records,
                                    const StepNumbers& steps, const RowUse& use) {
  return use_rows(step_number_columns(records, steps), steps.numbers, use);
}

std::string diagnostics_csv(const std::vector<TrialRecord>& records, const StepNumbers& steps) {
  return csv_of(step_number_columns(records, steps), steps.numbers);
}

}  // namespace croon::experiments
