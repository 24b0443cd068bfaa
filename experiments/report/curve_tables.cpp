#include "experiments/report/result_tables.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {

std::string basin_csv(const Basin& basin) {
  Table table{{{"variant"}, {"sensor"}, {"level"}, {"size"}, {"unit"}, {"trials"}, {"success"}},
              {}};
  for (const char* name : {"success_ratio", "low", "high"}) table.columns.push_back({name});
  for (const BasinRow& row : basin.rows) {
    for (int level = 0; level < static_cast<int>(row.levels.size()); ++level) {
      const Share& share = row.levels[static_cast<std::size_t>(level)];
      table.rows.push_back(cell_row(row.variant, name_of_sensor(row.sensor), level,
                                    rounded_size(basin.sweep, level), size_unit(basin.sweep),
                                    share.trials, share.count, share.ratio, low_of(share.interval),
                                    high_of(share.interval)));
    }
  }
  return csv_table(table);
}

std::string success_curve_csv(const SuccessCurve& curve) {
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
  return csv_table(table);
}

std::string verdicts_csv(const AcceptanceCurve& acceptance) {
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
  return csv_table(table);
}

std::string coverage_csv(const Coverage& coverage) {
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
  for (const CoverageRow& row : coverage.rows) {
    for (std::size_t k = 0; k < row.held.size(); ++k) {
      const Share& share = row.held[k];
      table.rows.push_back(cell_row(row.variant, name_of_sensor(row.sensor), name_of_dof(row),
                                    kCoverageLevels.at(k), share.trials, share.count, share.ratio,
                                    low_of(share.interval), high_of(share.interval)));
    }
  }
  return csv_table(table);
}

std::string nees_csv(const Coverage& coverage) {
  Table table{
      {{"variant"}, {"sensor"}, {"trials"}, {"mean"}, {"median"}, {"median_low"}, {"median_high"}},
      {}};
  for (const NormalisedErrors& errors : coverage.errors) {
    table.rows.push_back(cell_row(errors.variant, name_of_sensor(errors.sensor), errors.trials,
                                  errors.mean, errors.median, low_of(errors.interval),
                                  high_of(errors.interval)));
  }
  return csv_table(table);
}

}  // namespace croon::experiments
