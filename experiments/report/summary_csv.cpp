#include <cmath>
#include <limits>

#include "experiments/report/csv_row.hpp"
#include "experiments/report/statistic_names.hpp"
#include "experiments/report/summary.hpp"

namespace croon::experiments {

namespace {

constexpr const char* kSpreads[] = {"within_scene_std", "across_scenes_std"};

std::string joined(const Measure& measure, const char* statistic) {
  return std::string(measure.name) + "_" + statistic + "_" + measure.unit;
}

void add_statistic_names(CsvRow& header) {
  for (const Measure& measure : kMeasures) {
    for (const Statistic& statistic : kStatistics) header.text(joined(measure, statistic.name));
  }
}

void add_statistics(CsvRow& row, const std::optional<StatisticsTable>& statistics) {
  for (std::size_t k = 0; k < kMeasures.size(); ++k) {
    for (const Statistic& statistic : kStatistics) {
      const double value =
          statistics ? (*statistics)[k].*statistic.value : std::numeric_limits<double>::quiet_NaN();
      std::isnan(value) ? row.empty() : row.number(value);
    }
  }
}

std::string csv_header() {
  CsvRow header;
  for (const char* name :
       {"variant", "sensor", "reference", "trials", "success", "inaccurate", "rejected", "failed",
        "success_ratio", "success_low_ratio", "success_high_ratio", "agreement", "agreement_ratio",
        "agreement_low_ratio", "agreement_high_ratio", "counted"}) {
    header.text(name);
  }
  add_statistic_names(header);
  for (const char* spread : kSpreads) {
    for (std::size_t k = 0; k < kDofs; ++k) header.text(joined(kMeasures[k], spread));
  }
  return header.line();
}

void add_share(CsvRow& row, const Share& share) {
  row.number(share.ratio).number(share.interval.low).number(share.interval.high);
}

std::string loop_header() {
  CsvRow header;
  for (const char* name : {"variant", "pair", "source", "target", "loops", "closed", "closed_ratio",
                           "closed_low_ratio", "closed_high_ratio", "counted"}) {
    header.text(name);
  }
  add_statistic_names(header);
  return header.line();
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
  add_statistics(row, summary.statistics);
  for (const auto& spread : {summary.within_scene_std, summary.across_scenes_std}) {
    for (std::size_t k = 0; k < kDofs; ++k) spread ? row.number((*spread)[k]) : row.empty();
  }
  return row.line();
}

std::string kind_header() {
  CsvRow header;
  for (const char* name :
       {"variant", "kind", "sensor", "reference", "scenes", "trials", "success", "inaccurate",
        "rejected", "failed", "success_ratio", "success_low_ratio", "success_high_ratio",
        "agreement", "agreement_ratio", "agreement_low_ratio", "agreement_high_ratio", "counted"}) {
    header.text(name);
  }
  add_statistic_names(header);
  return header.line();
}

std::string kind_line(const KindSummary& kind) {
  const Outcomes& outcomes = kind.outcomes;
  CsvRow row;
  row.text(kind.variant).text(kind.kind).text(kind.sensor.empty() ? "all" : kind.sensor);
  row.text(reference_name(kind.reference));
  row.count(kind.scenes).count(outcomes.trials).count(outcomes.success);
  row.count(outcomes.inaccurate).count(outcomes.rejected).count(outcomes.failed);
  add_share(row, kind.success);
  row.count(kind.agreement.count);
  add_share(row, kind.agreement);
  row.count(kind.counted);
  add_statistics(row, kind.statistics);
  return row.line();
}

}  // namespace

std::string summary_by_kind_csv(const Summary& summary) {
  std::string bytes = kind_header();
  for (const KindSummary& kind : summary.kinds) bytes += kind_line(kind);
  return bytes;
}

std::string summary_csv(const Summary& summary) {
  std::string bytes = csv_header();
  for (const SummaryRow& row : summary.rows) bytes += csv_line(row);
  return bytes;
}

std::string loops_csv(const Summary& summary) {
  std::string bytes = loop_header();
  for (const LoopClosure& loop : summary.loops) {
    CsvRow row;
    row.text(loop.variant).text(loop.pair.name).text(loop.pair.source).text(loop.pair.target);
    row.count(loop.closed.trials).count(loop.closed.count);
    add_share(row, loop.closed);
    row.count(loop.counted);
    add_statistics(row, loop.statistics);
    bytes += row.line();
  }
  return bytes;
}

}  // namespace croon::experiments
