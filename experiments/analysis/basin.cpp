#include "experiments/analysis/basin.hpp"

#include <cmath>
#include <map>
#include <set>

namespace croon::experiments {
namespace {

/// Sensors known to have no ground truth, and sensors with a trial that finished without an error.
std::set<std::string> sensors_left_out(const std::vector<TrialRecord>& records,
                                       const ReportOrder& order) {
  std::set<std::string> sensors = order.without_truth;
  for (const TrialRecord& record : records) {
    if (record.T_reference_sensor && !record.error) sensors.insert(record.id.sensor);
  }
  return sensors;
}

/// The maximum size up to which every level `is_inside`; std::nullopt if the first is not.
template <class F>
std::optional<double> reach(const Sweep& sweep, const BasinRow& row, const F& is_inside) {
  std::optional<double> size;
  for (std::size_t level = 0; level < row.levels.size(); ++level) {
    if (!is_inside(row.levels[level])) break;
    size = level_size(sweep, static_cast<int>(level));
  }
  return size;
}

}  // namespace

std::optional<Basin> basin_of(const std::vector<TrialRecord>& records, const Sweep& sweep,
                              const ReportOrder& order) {
  const std::set<std::string> left_out = sensors_left_out(records, order);
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
  const Share& first = row.levels.front();
  return reach(sweep, row, [&](const Share& share) {
    // Both ratios multiplied by both numbers of trials.
    const double min_count = kBasinRatio * first.count * share.trials;
    return share.count > 0 && static_cast<double>(share.count) * first.trials >= min_count;
  });
}

std::optional<Interval> basin_radius_interval(const Sweep& sweep, const BasinRow& row) {
  const Share& first = row.levels.front();
  if (first.count == 0 || !first.interval) return std::nullopt;
  const auto reach_by = [&](double Interval::*end) {
    return *reach(sweep, row, [&](const Share& share) {
      // The first level is always in the basin.
      return &share == &first ||
             (share.interval && (*share.interval).*end >= kBasinRatio * first.ratio);
    });
  };
  return Interval{reach_by(&Interval::low), reach_by(&Interval::high)};
}

double rounded_size(const Sweep& sweep, int level) {
  return std::round(1e6 * level_size(sweep, level)) / 1e6;
}

const char* size_unit(const Sweep& sweep) { return sweep.of == SweepOf::rotation ? "deg" : "m"; }

}  // namespace croon::experiments
