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

}  // namespace

Columns<TrialId> id_columns() {
  Columns<TrialId> columns;
  return columns.add({"variant"}, &TrialId::variant)
      .add({"scene"}, &TrialId::scene)
      .add({"sensor"}, &TrialId::sensor)
      .add({"trial"}, &TrialId::trial);
}

std::vector<Column> comparison_rows(const Summary& summary, const RowUse& use) {
  return use_rows(comparison_columns(), summary.comparisons, use);
}

std::vector<Column> diagnostic_rows(const std::vector<TrialRecord>& records,
                                    const StepNumbers& steps, const RowUse& use) {
  return use_rows(step_number_columns(records, steps), steps.numbers, use);
}

std::string timings_csv(const std::vector<TimingRow>& rows) {
  Columns<TimingRow> columns;
  columns.add(id_columns(), &TimingRow::id)
      .add({"step"}, &TimingRow::step)
      .add({"seconds"}, &TimingRow::seconds);
  return csv_of(columns, rows);
}

std::string diagnostics_csv(const std::vector<TrialRecord>& records, const StepNumbers& steps) {
  return csv_of(step_number_columns(records, steps), steps.numbers);
}

}  // namespace croon::experiments
