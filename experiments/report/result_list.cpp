#include "experiments/report/result_list.hpp"

#include <algorithm>
#include <stdexcept>

#include "experiments/report/figures.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/picture/writers.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {
namespace {

using FileBytes = std::optional<std::string>;

/// A row per variant, sensor ("all" for all sensors together) and level.
Table basin_table(const Results& results) {
  Table table{{{"variant"}, {"sensor"}, {"level"}, {"size"}, {"unit"}, {"trials"}, {"success"}},
              {}};
  for (const char* name : {"success_ratio", "low", "high"}) table.columns.push_back({name});
  if (!results.basin) return table;
  const Basin& basin = *results.basin;
  for (const BasinRow& row : basin.rows) {
    for (int level = 0; level < static_cast<int>(row.levels.size()); ++level) {
      const Share& share = row.levels[static_cast<std::size_t>(level)];
      table.rows.push_back(cell_row(row.variant, name_of_sensor(row.sensor), level,
                                    rounded_size(basin.sweep, level), size_unit(basin.sweep),
                                    share.trials, share.count, share.ratio, low_of(share.interval),
                                    high_of(share.interval)));
    }
  }
  return table;
}

/// A row per variant, sensor, bounded error (rotation, translation or both) and threshold; an
/// unused bound is empty.
Table success_curve_table(const Results& results) {
  const SuccessCurve& curve = results.summary.curve;
  Table table{{{"variant"},
               {"sensor"},
               {"of"},
               {"rotation", "deg"},
               {"translation", "m"},
               {"trials"},
               {"within"},
               {"within", "ratio"},
               {"within_low", "ratio"},
               {"within_high", "ratio"}},
              {}};
  for (const CurveRow& row : curve.rows) {
    for (std::size_t i = 0; i < row.shares.size(); ++i) {
      const Share& share = row.shares[i];
      const SuccessBounds& bounds = curve.thresholds[i];
      const Cell rotation = row.of == CurveOf::translation ? Cell() : to_cell(bounds.rotation_deg);
      const Cell translation = row.of == CurveOf::rotation ? Cell() : to_cell(bounds.translation_m);
      table.rows.push_back(cell_row(row.variant, name_of_sensor(row.sensor), name_of(row.of),
                                    rotation, translation, share.trials, share.count, share.ratio,
                                    low_of(share.interval), high_of(share.interval)));
    }
  }
  return table;
}

/// A row per variant, sensor and threshold of rotation and translation, above which a pose is
/// wrong.
Table verdicts_table(const Results& results) {
  const AcceptanceCurve& acceptance = results.acceptance;
  Table table{{{"variant"},
               {"sensor"},
               {"rotation", "deg"},
               {"translation", "m"},
               {"trials"},
               {"accepted_right"},
               {"accepted_wrong"},
               {"rejected_right"},
               {"rejected_wrong"},
               {"failed"}},
              {}};
  for (const AcceptanceRow& row : acceptance.rows) {
    for (std::size_t i = 0; i < row.at_thresholds.size(); ++i) {
      const SuccessBounds& bounds = acceptance.thresholds[i];
      const AcceptanceCounts& counts = row.at_thresholds[i];
      table.rows.push_back(cell_row(row.variant, name_of_sensor(row.sensor), bounds.rotation_deg,
                                    bounds.translation_m, counts.trials(), counts.accepted_right,
                                    counts.accepted_wrong, counts.rejected_right,
                                    counts.rejected_wrong, counts.failed));
    }
  }
  return table;
}

/// A row per variant, sensor, degree of freedom ("all" for the ellipsoid of all six) and level.
Table coverage_table(const Results& results) {
  Table table{{{"variant"},
               {"sensor"},
               {"dof"},
               {"level", "ratio"},
               {"trials"},
               {"held"},
               {"held", "ratio"},
               {"held_low", "ratio"},
               {"held_high", "ratio"}},
              {}};
  for (const CoverageRow& row : results.coverage.rows) {
    for (std::size_t k = 0; k < row.held.size(); ++k) {
      const Share& share = row.held[k];
      table.rows.push_back(cell_row(row.variant, name_of_sensor(row.sensor), name_of_dof(row),
                                    kCoverageLevels.at(k), share.trials, share.count, share.ratio,
                                    low_of(share.interval), high_of(share.interval)));
    }
  }
  return table;
}

/// A row per variant and sensor.
Table nees_table(const Results& results) {
  Table table{
      {{"variant"}, {"sensor"}, {"trials"}, {"mean"}, {"median"}, {"median_low"}, {"median_high"}},
      {}};
  for (const NormalisedErrors& errors : results.coverage.errors) {
    table.rows.push_back(cell_row(errors.variant, name_of_sensor(errors.sensor), errors.trials,
                                  errors.mean, errors.median, low_of(errors.interval),
                                  high_of(errors.interval)));
  }
  return table;
}

/// The CSV file of a table; missing if the table has no rows.
ResultFile csv_file(const char* name, Table (*table_of)(const Results& results)) {
  return {name, [table_of](const Results& results) {
            const Table table = table_of(results);
            return table.rows.empty() ? std::nullopt : FileBytes(csv_table(table));
          }};
}

std::vector<ResultFile> all_files() {
  using R = Results;
  // Tables with a row per trial are rendered row by row.
  std::vector<ResultFile> files = {
      {"trials.csv", [](const R& r) { return trials_csv(r.records, r.summary); }},
      {"summary.csv", [](const R& r) { return summary_csv(r.summary); }},
      {"summary.json", [](const R& r) { return summary_json(r.summary, r.claims, r.diagnostics); }},
      {"diagnostics.csv",
       [](const R& r) {
         return r.steps.numbers.empty() ? FileBytes() : diagnostics_csv(r.records, r.steps);
       }},
      {"extrinsics.json", [](const R& r) { return extrinsics_json(r.summary, r.references); }},
      csv_file("summary_by_kind.csv",
               [](const R& r) { return scene_kind_columns().table(r.summary.scene_kinds); }),
      csv_file("comparison.csv",
               [](const R& r) { return comparison_columns().table(r.summary.comparisons); }),
      csv_file(
          "comparison_by_dof.csv",
          [](const R& r) { return dof_comparison_columns().table(r.summary.dof_comparisons); }),
      csv_file("loops.csv", [](const R& r) { return loop_columns().table(r.summary.loops); }),
      csv_file("success_curve.csv", success_curve_table),
      csv_file("verdicts.csv", verdicts_table),
      csv_file("covariance.csv",
               [](const R& r) {
                 Table table;
                 table.columns = covariance_rows(
                     r.records, [&](const CellRow& row) { table.rows.push_back(row); });
                 return table;
               }),
      csv_file("coverage.csv", coverage_table),
      csv_file("nees.csv", nees_table),
      csv_file("basin.csv", basin_table)};
  for (const Figure& figure : figures()) {
    files.push_back({std::string(figure.name) + ".svg", [&figure](const R& r) {
                       const std::optional<Drawing> drawing = figure.draw(r, {});
                       return drawing ? FileBytes(svg_bytes(*drawing)) : std::nullopt;
                     }});
  }
  return files;
}

}  // namespace

const std::vector<ResultFile>& result_files() {
  static const std::vector<ResultFile> files = all_files();
  return files;
}

std::string result_file(const std::string& name, const Results& results) {
  const auto is_it = [&](const ResultFile& file) { return file.name == name; };
  const auto found = std::find_if(result_files().begin(), result_files().end(), is_it);
  if (found == result_files().end()) throw std::out_of_range(name);
  return found->bytes(results).value_or("");
}

}  // namespace croon::experiments
