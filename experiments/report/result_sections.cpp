#include "experiments/report/result_sections.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "experiments/report/build_text.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/statistics.hpp"
#include "framework/base/text.hpp"
#include "framework/document/renderers.hpp"

namespace croon::experiments {

namespace {

/// A section of one table with all its columns.
Section table_section(const char* id, const char* title, const std::string& caption,
                      const Table& table, std::size_t names,
                      const std::vector<std::string>& notes = {}) {
  return {id, title, {TableBlock{caption, table, whole_view(table, names), notes}}};
}

std::vector<Section> without_empty(std::vector<Section> sections) {
  const auto is_empty = [](const Section& section) { return section.blocks.empty(); };
  sections.erase(std::remove_if(sections.begin(), sections.end(), is_empty), sections.end());
  return sections;
}

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

}  // namespace

Section verdicts_section(const Results& results) {
  if (results.acceptance.rows.empty()) return {};
  using Row = AcceptanceRow;
  using Counts = AcceptanceCounts;
  Columns<Row> columns;
  columns.add({"variant"}, &Row::variant).add({"sensor"}, [](const Row& row) {
    return name_of_sensor(row.sensor);
  });
  for (const auto& [name, count] : {std::pair("accepted, right", &Counts::accepted_right),
                                    std::pair("accepted, wrong", &Counts::accepted_wrong),
                                    std::pair("rejected, right", &Counts::rejected_right),
                                    std::pair("rejected, wrong", &Counts::rejected_wrong),
                                    std::pair("failed", &Counts::failed)}) {
    columns.add({name}, [count = count](const Row& row) { return row.at_bounds.*count; });
  }
  return table_section("verdicts", "Verdicts",
                       "Poses that the program accepts and rejects; right: within " +
                           bounds_text(results.summary.bounds) + "ground truth.",
                       columns.table(results.acceptance.rows), 2);
}

Section coverage_section(const Results& results) {
  const Coverage& coverage = results.coverage;
  if (coverage.rows.empty()) return {};
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
      return with_interval(row.held.at(k).ratio, row.held.at(k).interval, 1, 100.0);
    });
  }
  columns.add({"nees"}, [&](const Row& row) -> std::optional<std::string> {
    const auto is_it = [&](const NormalisedErrors& errors) {
      return errors.variant == row.variant && errors.sensor == row.sensor;
    };
    const auto found = std::find_if(coverage.errors.begin(), coverage.errors.end(), is_it);
    if (row.dof || found == coverage.errors.end()) return std::nullopt;
    return with_interval(found->median, found->interval, 2);
  });
  return table_section(
      "covariances", "Covariances",
      "Intervals that contain ground truth, in % of accepted trials [95 % interval over scenes].",
      columns.table(of_all_sensors(coverage.rows)), 3,
      {"NEES: normalised squared error (expected median: 5.35)."});
}

Section basin_section(const Results& results) {
  if (!results.basin) return {};
  const Sweep& sweep = results.basin->sweep;
  constexpr std::size_t kMaxColumns = 19;
  const auto levels = static_cast<std::size_t>(sweep.levels);
  const std::size_t step = (levels + kMaxColumns - 1) / kMaxColumns;
  Columns<BasinRow> columns;
  columns.add({"variant"}, &BasinRow::variant);
  for (std::size_t level = 0; level < levels; level += step) {
    columns.add({shortest_number(rounded_size(sweep, static_cast<int>(level)))},
                [level](const BasinRow& row) {
                  const Share& share = row.levels[level];
                  return share.trials == 0 ? std::nullopt : std::optional(100.0 * share.ratio);
                });
  }
  const auto rounded = [](double size) { return std::round(1e6 * size) / 1e6; };
  const std::string unit = size_unit(sweep);
  columns
      .add({"radius " + unit, "", "", kAllDigits},
           [&](const BasinRow& row) {
             const std::optional<double> radius = basin_radius(sweep, row);
             return radius ? std::optional(rounded(*radius)) : std::nullopt;
           })
      .add({"95 % interval"}, [&](const BasinRow& row) -> std::optional<std::string> {
        const std::optional<Interval> ends = basin_radius_interval(sweep, row);
        if (!ends) return std::nullopt;
        return "[" + plain_number(rounded(ends->low)) + ", " + plain_number(rounded(ends->high)) +
               "]";
      });
  const char* const change = sweep.of == SweepOf::rotation ? "rotated by" : "moved by";
  return table_section(
      "basin", "Basin",
      "Success in % for initial guesses " + std::string(change) + " ... " + unit + ".",
      columns.table(of_all_sensors(results.basin->rows)), 1,
      {"Radius: maximum size up to which each level has at least " +
           fixed_number(100.0 * kBasinRatio, 0) + " % of the success at the first level.",
       "95 % interval: of the radius, over scenes; requires at least " +
           std::to_string(kMinScenes) + " scenes."});
}

Section builds_section(const Results& results) {
  Section section{"builds", "Builds", {}};
  for (const std::string& sentence : build_sentences(results.builds)) {
    section.blocks.emplace_back(Paragraph{sentence});
  }
  return section;
}

std::vector<Section> result_sections(const Results& results) {
  return without_empty({summary_section(results), verdicts_section(results),
                        coverage_section(results), basin_section(results), claims_section(results),
                        quoted_section(results), builds_section(results)});
}

std::string result_text(const Results& results, bool colours) {
  return text_section({"results", results.name, {}, result_sections(results)}, colours);
}

Section claims_page(const Results& results) {
  Section page{"run", results.name, {}};
  if (!results.description.empty()) page.blocks.emplace_back(Paragraph{results.description});
  page.blocks.emplace_back(Facts{{{"scenes", std::to_string(results.scenes)},
                                  {"sensors", std::to_string(sensors_of(results.summary).size())},
                                  {"starts of each", std::to_string(results.trials)},
                                  {"trials", std::to_string(results.records.size()) + " of " +
                                                 std::to_string(results.planned)},
                                  {"seed", std::to_string(results.seed)},
                                  {"commit", results.commit}}});
  const std::vector<Block> builds = builds_section(results).blocks;
  page.blocks.insert(page.blocks.end(), builds.begin(), builds.end());
  page.sections = without_empty({claims_section(results), quoted_section(results)});
  if (page.sections.empty()) {
    page.blocks.emplace_back(Paragraph{"The experiment makes no claims."});
  }
  return page;
}

Section clouds_section(const std::vector<CloudDescription>& clouds) {
  const Table all = cloud_columns().table(clouds);
  const std::size_t first = all.index_of("points");
  Table table{{{"sensor"}, {"dataset"}}, {}};
  table.columns.insert(table.columns.end(),
                       all.columns.begin() + static_cast<std::ptrdiff_t>(first), all.columns.end());
  std::map<std::pair<std::string, std::string>, std::vector<CellRow>> groups;
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    groups[{all.text_at(i, "sensor"), all.text_at(i, "dataset")}].push_back(all.rows[i]);
  }
  for (const auto& [names, rows] : groups) {
    CellRow row = cell_row(names.first, names.second);
    for (std::size_t k = first; k < all.columns.size(); ++k) {
      row.push_back(range_cell(rows, k, all.columns[k].decimals));
    }
    table.rows.push_back(std::move(row));
  }
  return table_section(
      "clouds", "Clouds",
      "Median over scenes (minimum to maximum); ground: within 0.2 m of the largest plane.", table,
      2,
      {"Distance to the reference's nearest point, over the points with one within 1 m "
       "(overlap)."});
}

Section plan_section(const PlanCounts& plan) {
  Section section{"plan",
                  "Plan",
                  {Paragraph{std::to_string(plan.trials) + " trials to run from " +
                             std::to_string(plan.starts) + " starts; " + std::to_string(plan.done) +
                             " are in the store"}}};
  if (plan.steps.empty()) return section;
  std::vector<StepCount> steps = plan.steps;
  StepCount all{"all steps"};
  for (const StepCount& step : steps) {
    all.alone += step.alone;
    all.runs += step.runs;
  }
  steps.push_back(all);
  using S = StepCount;
  Columns<S> columns;
  columns.add({"step"}, &S::step)
      .add({"one by one"}, &S::alone)
      .add({"runs"}, &S::runs)
      .add({"saved"}, [](const S& step) { return step.alone - step.runs; })
      .add({"saved %", "", "", 1}, [](const S& step) {
        const double ratio = static_cast<double>(step.runs) / static_cast<double>(step.alone);
        return step.alone == 0 ? 0.0 : 100.0 * (1.0 - ratio);
      });
  const Table table = columns.table(steps);
  section.blocks.emplace_back(TableBlock{"", table, whole_view(table)});
  return section;
}

}  // namespace croon::experiments
