#include "experiments/report/basin.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/report/csv_row.hpp"
#include "experiments/report/scene_summary.hpp"
#include "experiments/report/text.hpp"
#include "experiments/report/text_table.hpp"

namespace croon::experiments {
namespace {

/// Successes of trials.
struct Count {
  int success = 0;
  int trials = 0;
};

/// The counts of each level by variant and sensor.
using Counts = std::map<std::pair<std::string, std::string>, std::vector<Count>>;

/// The sensors of which a trial finished and has no error.
std::set<std::string> sensors_without_truth(const std::vector<TrialRecord>& records) {
  std::set<std::string> sensors;
  for (const TrialRecord& record : records) {
    if (record.T_reference_sensor && !record.error) sensors.insert(record.id.sensor);
  }
  return sensors;
}

Counts counted(const std::vector<TrialRecord>& records, const Sweep& sweep) {
  const std::set<std::string> left_out = sensors_without_truth(records);
  Counts counts;
  for (const TrialRecord& record : records) {
    if (left_out.count(record.id.sensor) > 0) continue;
    for (const std::string& sensor : {record.id.sensor, std::string()}) {
      std::vector<Count>& levels = counts[{record.id.variant, sensor}];
      levels.resize(static_cast<std::size_t>(sweep.levels));
      Count& count = levels[static_cast<std::size_t>(level_of(sweep, record.id.trial))];
      ++count.trials;
      if (record.status == Status::success) ++count.success;
    }
  }
  return counts;
}

/// The size without the rounding of equal steps.
std::string size_text(const Sweep& sweep, std::size_t level) {
  return shortest_number(std::round(1e6 * level_size(sweep, static_cast<int>(level))) / 1e6);
}

}  // namespace

std::optional<Basin> basin_of(const std::vector<TrialRecord>& records, const Sweep& sweep,
                              const ReportOrder& order) {
  const Counts counts = counted(records, sweep);
  std::vector<std::string> sensors = completed(order.sensors, records, &TrialId::sensor);
  sensors.emplace_back();
  Basin basin{sweep, {}};
  for (const std::string& variant : completed(order.variants, records, &TrialId::variant)) {
    for (const std::string& sensor : sensors) {
      const auto found = counts.find({variant, sensor});
      if (found == counts.end()) continue;
      basin.rows.push_back({variant, sensor, {}});
      for (const Count& count : found->second) {
        basin.rows.back().levels.push_back(share_of(count.success, count.trials));
      }
    }
  }
  if (basin.rows.empty()) return std::nullopt;
  return basin;
}

std::optional<double> basin_radius(const Sweep& sweep, const BasinRow& row) {
  std::optional<double> radius;
  for (std::size_t level = 0; level < row.levels.size(); ++level) {
    const Share& share = row.levels[level];
    if (share.count < kBasinRatio * share.trials || share.trials == 0) break;
    radius = level_size(sweep, static_cast<int>(level));
  }
  return radius;
}

const char* size_unit(const Sweep& sweep) { return sweep.of == SweepOf::rotation ? "deg" : "m"; }

std::string basin_csv(const Basin& basin) {
  std::string bytes = "variant,sensor,level,size,unit,trials,success,success_ratio,low,high\n";
  for (const BasinRow& row : basin.rows) {
    for (std::size_t level = 0; level < row.levels.size(); ++level) {
      const Share& share = row.levels[level];
      CsvRow line;
      line.text(row.variant).text(row.sensor.empty() ? "all" : row.sensor);
      line.count(static_cast<long long>(level)).text(size_text(basin.sweep, level));
      line.text(size_unit(basin.sweep)).count(share.trials).count(share.count);
      line.number(share.ratio).number(share.interval.low).number(share.interval.high);
      bytes += line.line();
    }
  }
  return bytes;
}

std::string basin_table(const Basin& basin, const TableStyle& style) {
  constexpr std::size_t kMaxColumns = 19;
  const auto levels = static_cast<std::size_t>(basin.sweep.levels);
  const std::size_t step = (levels + kMaxColumns - 1) / kMaxColumns;
  const std::string unit = size_unit(basin.sweep);
  std::vector<std::string> header = {"variant"};
  for (std::size_t level = 0; level < levels; level += step) {
    header.push_back(size_text(basin.sweep, level));
  }
  header.push_back("radius " + unit);
  TextTable table(std::move(header), 1);
  for (const BasinRow& row : basin.rows) {
    if (!row.sensor.empty()) continue;
    std::vector<std::string> cells = {row.variant};
    for (std::size_t level = 0; level < levels; level += step) {
      const Share& share = row.levels[level];
      cells.push_back(share.trials == 0 ? "-" : fixed_number(100.0 * share.ratio, 0));
    }
    const std::optional<double> radius = basin_radius(basin.sweep, row);
    cells.push_back(radius ? shortest_number(std::round(1e6 * *radius) / 1e6) : "-");
    table.add(std::move(cells));
  }
  const char* const what = basin.sweep.of == SweepOf::rotation ? "rotated by" : "moved by";
  return "success in % of starts " + std::string(what) + " ... " + unit +
         "; radius: up to there, at least " + fixed_number(100.0 * kBasinRatio, 0) +
         " % at each level\n" + table.text(style.colours);
}

}  // namespace croon::experiments
