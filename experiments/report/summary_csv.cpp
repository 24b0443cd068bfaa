#include "experiments/report/csv_row.hpp"
#include "experiments/report/statistic_names.hpp"
#include "experiments/report/summary.hpp"

namespace croon::experiments {

namespace {

constexpr const char* kSpreads[] = {"within_scene_std", "across_scenes_std"};

std::string joined(const Measure& measure, const char* statistic) {
  return std::string(measure.name) + "_" + statistic + "_" + measure.unit;
}

std::string csv_header() {
  CsvRow header;
  for (const char* name :
       {"variant", "sensor", "reference", "trials", "success", "inaccurate", "rejected", "failed",
        "success_ratio", "success_low_ratio", "success_high_ratio", "agreement", "agreement_ratio",
        "agreement_low_ratio", "agreement_high_ratio", "counted"}) {
    header.text(name);
  }
  for (const Measure& measure : kMeasures) {
    for (const Statistic& statistic : kStatistics) header.text(joined(measure, statistic.name));
  }
  for (const char* spread : kSpreads) {
    for (std::size_t k = 0; k < kDofs; ++k) header.text(joined(kMeasures[k], spread));
  }
  return header.line();
}

void add_share(CsvRow& row, const Share& share) {
  row.number(share.ratio).number(share.interval.low).number(share.interval.high);
}

std::string csv_line(const SummaryRow& summary) {
  const Outcomes& outcomes = summary.outcomes;
  CsvRow row;
  row.text(summary.variant).text(summary.sensor).text(reference_name(summary.reference));
  row.count(outcomes.trials).count(outcomes.success).count(outcomes.inaccurate);
  row.count(outcomes.rejected).count(outcomes.failed);
  add_share(row, summary.success);
  row.count(summary.agreement.count);
  add_share(row, summary.agreement);
  row.count(summary.counted);
  for (std::size_t k = 0; k < kMeasures.size(); ++k) {
    for (const Statistic& statistic : kStatistics) {
      summary.statistics ? row.number((*summary.statistics)[k].*statistic.value) : row.empty();
    }
  }
  for (const auto& spread : {summary.within_scene_std, summary.across_scenes_std}) {
    for (std::size_t k = 0; k < kDofs; ++k) spread ? row.number((*spread)[k]) : row.empty();
  }
  return row.line();
}

}  // namespace

std::string summary_csv(const Summary& summary) {
  std::string bytes = csv_header();
  for (const SummaryRow& row : summary.rows) bytes += csv_line(row);
  return bytes;
}

}  // namespace croon::experiments
