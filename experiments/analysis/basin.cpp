#include "experiments/analysis/basin.hpp"

#include <cmath>
#include <map>
#include <set>

namespace croon::experiments {
namespace {

/// The sensors with a trial that finished and has no error.
std::set<std::string> sensors_without_truth(const std::vector<TrialRecord>& records) {
  std::set<std::string> sensors;
  for (const TrialRecord& record : records) {
    if (record.T_reference_sensor && !record.error) sensors.insert(record.id.sensor);
  }
  return sensors;
}

}  // namespace

std::optional<Basin> basin_of(const std::vector<TrialRecord>& records, const Sweep& sweep,
                              const ReportOrder& order) {
  const std::set<std::string> left_out = sensors_without_truth(records);
  std::map<std::pair<std::string, std::string>, std::vector<SceneCounts>> counts;
  for (const TrialRecord& record : records) {
    if (left_out.count(record.id.sensor) > 0) continue;
    for (const std::string& sensor : {record.id.sensor, std::string()}) {
      std::vector<SceneCounts>& levels = counts[{record.id.variant, sensor}];
      levels.resize(static_cast<std::size_t>(sweep.levels));
      levels[static_cast<std::size_t>(level_of(sweep, record.id.trial))].add(
          record.id.scene, record.status == Status::success, 1);
    }
  }
  std::vector<std::string> sensors = completed(order.sensors, records, &TrialId::sensor);
  sensors.emplace_back();
  Basin basin{sweep, {}};
  for (const std::string& variant : completed(order.variants, records, &TrialId::variant)) {
    for (const std::string& sensor : sensors) {
      std::vector<Share> levels;
      for (const SceneCounts& level : counts[{variant, sensor}]) levels.push_back(level.share());
      if (!levels.empty()) basin.rows.push_back({variant, sensor, levels});
    }
  }
  if (basin.rows.empty()) return std::nullopt;
  return basin;
}

std::optional<double> basin_radius(const Sweep& sweep, const BasinRow& row) {
  std::optional<double> radius;
  for (std::size_t level = 0; level < row.levels.size(); ++level) {
    const Share& share = row.levels[level];
    const Share& first = row.levels.front();
    // Both ratios times both numbers of trials.
    const double least = kBasinRatio * first.count * share.trials;
    if (share.count == 0 || static_cast<double>(share.count) * first.trials < least) break;
    radius = level_size(sweep, static_cast<int>(level));
  }
  return radius;
}

double rounded_size(const Sweep& sweep, int level) {
  return std::round(1e6 * level_size(sweep, level)) / 1e6;
}

const char* size_unit(const Sweep& sweep) { return sweep.of == SweepOf::rotation ? "deg" : "m"; }

}  // namespace croon::experiments
