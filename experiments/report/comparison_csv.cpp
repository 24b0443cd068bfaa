#include "experiments/report/csv_row.hpp"
#include "experiments/report/summary.hpp"

namespace croon::experiments {

namespace {

std::string header_line() {
  CsvRow header;
  for (const char* name :
       {"variant", "base", "sensor", "pairs", "scenes", "only_base", "only_variant"}) {
    header.text(name);
  }
  const auto add_test = [&](const std::string& of) {
    for (const char* name :
         {"_p", "_p_holm", "_p_by_scene", "_p_by_scene_holm", "_significant", "_by_scene"}) {
      header.text(of + name);
    }
  };
  for (const Measure& measure : {kMeasures[kDofs], kMeasures[kDofs + 1]}) {
    for (const char* name : {"base_median", "variant_median", "difference", "low", "high"}) {
      header.text(std::string(measure.name) + "_" + name + "_" + measure.unit);
    }
    add_test(measure.name);
  }
  add_test("success");
  return header.line();
}

void add_test(CsvRow& row, const PairedTest& test) {
  row.number(test.p).number(test.p_holm).number(test.p_by_scene).number(test.p_by_scene_holm);
  row.count(is_significant(test)).count(holds_by_scene(test));
}

void add_error(CsvRow& row, const ErrorComparison& error) {
  row.number(error.base_median).number(error.variant_median).number(error.difference);
  row.number(error.interval.low).number(error.interval.high);
  add_test(row, error.test);
}

}  // namespace

std::string comparison_csv(const Summary& summary) {
  std::string bytes = header_line();
  for (const Comparison& comparison : summary.comparisons) {
    CsvRow row;
    row.text(comparison.variant).text(comparison.base);
    row.text(comparison.sensor.empty() ? "all" : comparison.sensor);
    row.count(comparison.pairs).count(comparison.scenes);
    row.count(comparison.only_base).count(comparison.only_variant);
    add_error(row, comparison.rotation_deg);
    add_error(row, comparison.translation_m);
    add_test(row, comparison.success);
    bytes += row.line();
  }
  return bytes;
}

}  // namespace croon::experiments
