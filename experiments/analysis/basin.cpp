#include "experiments/analysis/basin.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace croon::experiments {
namespace {

/// Successes of trials.
struct Count {
  int success = 0;
  int trials = 0;
};

/// The counts of each level by variant and sensor.
using Counts = std::map<std::pair<std::string, std::string>, std::vector<Count>>;

/// The sensors with a trial that finished and has no error.
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

double rounded_size(const Sweep& sweep, int level) {
  return std::round(1e6 * level_size(sweep, level)) / 1e6;
}

const char* size_unit(const Sweep& sweep) { return sweep.of == SweepOf::rotation ? "deg" : "m"; }

}  // namespace croon::experiments
