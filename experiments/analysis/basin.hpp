#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/summary.hpp"
#include "experiments/file/start_rule.hpp"

namespace croon::experiments {

/// A level belongs to the basin if its success is at least this multiple of the first level's.
inline constexpr double kBasinRatio = 0.95;

/// The success of one variant over the levels of a sweep.
struct BasinRow {
  std::string variant;
  std::string sensor;         ///< Empty for all sensors together.
  std::vector<Share> levels;  ///< In ascending order of size.
};

/// The success of every variant over the levels of a sweep.
struct Basin {
  Sweep sweep;
  std::vector<BasinRow> rows;  ///< By variant, then sensor (all sensors together last).
};

/// The basin of the records of a sweep, over all trials, including failed ones. Sensors without
/// ground truth are left out, because their success does not judge the pose; std::nullopt if all
/// are. Independent of the order of the records.
std::optional<Basin> basin_of(const std::vector<TrialRecord>& records, const Sweep& sweep,
                              const ReportOrder& order);

/// The basin's radius, deg or m: the maximum size up to which, at every level, the share of trials
/// that succeed is at least `kBasinRatio` times that at the first level. So scenes that always fail
/// have no effect. std::nullopt if no trial succeeds at the first level.
std::optional<double> basin_radius(const Sweep& sweep, const BasinRow& row);

/// The interval of the radius over scenes. Its ends are the radii computed from the lower and the
/// upper ends of the levels' 95 % intervals, with the share at the first level unchanged. If an end
/// equals the last size, the true one may be larger. std::nullopt if there is no radius, or if
/// shares have no interval.
std::optional<Interval> basin_radius_interval(const Sweep& sweep, const BasinRow& row);

/// The size of a level, without rounding errors of equal steps.
double rounded_size(const Sweep& sweep, int level);

/// "deg" or "m".
const char* size_unit(const Sweep& sweep);

}  // namespace croon::experiments
