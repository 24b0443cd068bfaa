#include "experiments/report/run_text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "experiments/report/build_text.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/statistics.hpp"
#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {

namespace {

/// "21.6 (14.0 to 30.2)": median, minimum and maximum of the column `k` of `rows`; nothing if all
/// cells are empty.
Cell range_cell(const std::vector<CellRow>& rows, std::size_t k, int decimals) {
  std::vector<double> values;
  for (const CellRow& row : rows) {
    const Value& value = row[k].value;
    if (const auto* number = std::get_if<double>(&value)) values.push_back(*number);
    if (const auto* count = std::get_if<long long>(&value))
      values.push_back(static_cast<double>(*count));
  }
  if (values.empty()) return {};
  const auto text = [&](double value) { return fixed_number(value, decimals); };
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  const std::string range = " (" + text(*min) + " to " + text(*max) + ")";
  return to_cell(text(median(values)) + (values.size() > 1 ? range : ""));
}

/// The distinct texts of a column.
std::vector<std::string> texts_of(const Table& table, const std::string& column) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::string& text = table.text_at(i, column);
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
  }
  return texts;
}

}  // namespace

std::string result_text(const Results& results, bool colours) {
  TableStyle style;
  style.colours = colours;
  std::string text;
  if (results.scenes_per_trial > 1) {
    text = "each trial calibrates the rig from " + std::to_string(results.scenes_per_trial) +
           " scenes; a \"scene\" below is such a group\n";
  }
  text += summary_text(results.summary, style);
  if (!results.acceptance.rows.empty()) {
    text += "\nverdicts: poses that the program accepts and rejects; right: within " +
            bounds_text(results.summary.bounds) + "ground truth\n" +
            verdicts_text(results.acceptance, style);
  }
  if (!results.coverage.rows.empty()) {
    text +=
        "\ncovariances: intervals that contain ground truth, in % of accepted trials [95 % "
        "interval over scenes];\n  nees: normalised squared error (expected median: 5.35)\n" +
        coverage_text(results.coverage, style);
  }
  if (results.basin) text += "\n" + basin_text(*results.basin, style);
  const std::string claims = claims_text(results.claims, results.quoted, results.summary, style);
  if (!claims.empty()) text += "\n" + claims;
  for (const std::string& sentence : build_sentences(results.builds))
    text += "\n" + sentence + "\n";
  return text;
}

std::string verdicts_text(const AcceptanceCurve& acceptance, const TableStyle& style) {
  Table table{{{"variant"},
               {"sensor"},
               {"accepted, right"},
               {"accepted, wrong"},
               {"rejected, right"},
               {"rejected, wrong"},
               {"failed"}},
              {}};
  for (const AcceptanceRow& row : acceptance.rows) {
    const AcceptanceCounts& counts = row.at_bounds;
    table.rows.push_back(cell_row(row.variant, name_of_sensor(row.sensor), counts.accepted_right,
                                  counts.accepted_wrong, counts.rejected_right,
                                  counts.rejected_wrong, counts.failed));
  }
  return text_table(table, whole_view(table, 2), style.colours);
}

std::string coverage_text(const Coverage& coverage, const TableStyle& style) {
  using Row = CoverageRow;
  Columns<Row> columns;
  columns.add({"variant"}, &Row::variant)
      .add({"sensor"}, [](const Row& row) { return name_of_sensor(row.sensor); })
      .add({"dof"}, name_of_dof)
      .add({"trials"}, [](const Row& row) { return row.held.front().trials; });
  for (const double level : kShownCoverageLevels) {
    const auto k = static_cast<std::size_t>(
        std::find(kCoverageLevels.begin(), kCoverageLevels.end(), level) - kCoverageLevels.begin());
    columns.add({fixed_number(100.0 * level, 0) + " %"}, [k](const Row& row) {
      const Share& share = row.held.at(k);
      const auto percent = [](double ratio) { return fixed_number(100.0 * ratio, 1); };
      return percent(share.ratio) + (share.interval ? " [" + percent(share.interval->low) + ", " +
                                                          percent(share.interval->high) + "]"
                                                    : "");
    });
  }
  columns.add({"nees"}, [&](const Row& row) -> std::optional<std::string> {
    const auto is_it = [&](const NormalisedErrors& errors) {
      return errors.variant == row.variant && errors.sensor == row.sensor;
    };
    const auto found = std::find_if(coverage.errors.begin(), coverage.errors.end(), is_it);
    if (row.dof || found == coverage.errors.end()) return std::nullopt;
    return fixed_number(found->median, 2) +
           (found->interval ? " [" + fixed_number(found->interval->low, 2) + ", " +
                                  fixed_number(found->interval->high, 2) + "]"
                            : "");
  });
  std::vector<Row> shown;
  for (const Row& row : coverage.rows) {
    if (row.sensor.empty()) shown.push_back(row);
  }
  return text_table(columns.table(shown), whole_view(columns.table(shown), 3), style.colours);
}

std::string basin_text(const Basin& basin, const TableStyle& style) {
  constexpr std::size_t kMaxColumns = 19;
  const auto levels = static_cast<std::size_t>(basin.sweep.levels);
  const std::size_t step = (levels + kMaxColumns - 1) / kMaxColumns;
  const std::string unit = size_unit(basin.sweep);
  Columns<BasinRow> columns;
  columns.add({"variant"}, &BasinRow::variant);
  for (std::size_t level = 0; level < levels; level += step) {
    const std::string size = shortest_number(rounded_size(basin.sweep, static_cast<int>(level)));
    columns.add({size}, [level](const BasinRow& row) {
      const Share& share = row.levels[level];
      return share.trials == 0 ? std::nullopt : std::optional<double>(100.0 * share.ratio);
    });
  }
  const auto rounded = [](double size) { return std::round(1e6 * size) / 1e6; };
  columns.add({"radius " + unit, "", "", kAllDigits}, [&](const BasinRow& row) {
    const std::optional<double> radius = basin_radius(basin.sweep, row);
    return radius ? std::optional<double>(rounded(*radius)) : std::nullopt;
  });
  const std::size_t shown = columns.columns().size();
  for (const auto& [name, end] :
       {std::pair("low", &Interval::low), std::pair("high", &Interval::high)}) {
    columns.add({name, "", "", kAllDigits}, [&, end = end](const BasinRow& row) {
      const std::optional<Interval> interval = basin_radius_interval(basin.sweep, row);
      return interval ? std::optional<double>(rounded((*interval).*end)) : std::nullopt;
    });
  }
  std::vector<BasinRow> rows;
  for (const BasinRow& row : basin.rows) {
    if (row.sensor.empty()) rows.push_back(row);
  }
  const Table table = columns.table(rows);
  View view = whole_view(table);
  view.columns.resize(shown);
  view.columns.push_back({"95 % interval", "[<low>, <high>]"});
  const char* const change = basin.sweep.of == SweepOf::rotation ? "rotated by" : "moved by";
  return "success in % for initial guesses " + std::string(change) + " ... " + unit +
         "; radius: maximum size up to which each level has at least " +
         fixed_number(100.0 * kBasinRatio, 0) +
         " %\n  of the success at the first level; its interval: over scenes (requires at least " +
         std::to_string(kMinScenes) + " scenes)\n" + text_table(table, view, style.colours);
}

std::string clouds_text(const std::vector<CloudDescription>& clouds) {
  const Table all = cloud_columns().table(clouds);
  const std::size_t first = all.index_of("points");
  Table table{{{"sensor"}, {"dataset"}}, {}};
  table.columns.insert(table.columns.end(),
                       all.columns.begin() + static_cast<std::ptrdiff_t>(first), all.columns.end());
  for (const std::string& sensor : texts_of(all, "sensor")) {
    for (const std::string& dataset : texts_of(all, "dataset")) {
      std::vector<CellRow> rows;
      for (std::size_t i = 0; i < all.rows.size(); ++i) {
        const bool is_of_both =
            all.text_at(i, "sensor") == sensor && all.text_at(i, "dataset") == dataset;
        if (is_of_both) rows.push_back(all.rows[i]);
      }
      if (rows.empty()) continue;
      CellRow row = cell_row(sensor, dataset);
      for (std::size_t k = first; k < all.columns.size(); ++k) {
        row.push_back(range_cell(rows, k, all.columns[k].decimals));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return text_table(table, whole_view(table, 2));
}

std::string plan_text(const PlanCounts& plan, bool colours) {
  std::string text = std::to_string(plan.trials) + " trials to run from " +
                     std::to_string(plan.starts) + " starts; " + std::to_string(plan.done) +
                     " are in the store\n";
  if (plan.steps.empty()) return text;
  Table table{{{"step"}, {"one by one"}, {"runs"}, {"saved"}, {"saved %", "", "", 1}}, {}};
  const auto add = [&](const StepCount& step) {
    const double ratio = static_cast<double>(step.runs) / static_cast<double>(step.alone);
    table.rows.push_back(cell_row(step.step, step.alone, step.runs, step.alone - step.runs,
                                  step.alone == 0 ? 0.0 : 100.0 * (1.0 - ratio)));
  };
  StepCount all{"all steps"};
  for (const StepCount& step : plan.steps) {
    add(step);
    all.alone += step.alone;
    all.runs += step.runs;
  }
  add(all);
  return text + "\n" + text_table(table, whole_view(table), colours);
}

}  // namespace croon::experiments
