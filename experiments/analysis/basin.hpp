#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/summary.hpp"
#include "experiments/file/start_rule.hpp"

namespace croon::experiments {

/// The success of a level that belongs to the basin, as a share of that of the first level.
inline constexpr double kBasinRatio = 0.95;

/// The success of one variant over the levels of a sweep.
struct BasinRow {
  std::string variant;
  std::string sensor;         ///< Empty for all sensors together.
  std::vector<Share> levels;  ///< From the smallest size.
};

/// The success of every variant over the levels of a sweep.
struct Basin {
  Sweep sweep;
  std::vector<BasinRow> rows;  ///< By variant, then sensor, all together last.
};

/// The basin of the records of a sweep; all trials count, those that failed too. Sensors without
/// truth are left out, because their success says nothing about the pose; std::nullopt if all are.
/// The order of the records makes no difference.
std::optional<Basin> basin_of(const std::vector<TrialRecord>& records, const Sweep& sweep,
                              const ReportOrder& order);

/// The basin's radius, deg or m: the largest size up to which, at every level, the share of trials
/// that succeed is at least `kBasinRatio` of that at the first level. So scenes that fail from
/// every start do not count. std::nullopt if no trial succeeds at the first level.
std::optional<double> basin_radius(const Sweep& sweep, const BasinRow& row);

/// The interval of the radius over scenes, from the 95 % intervals of the levels' shares: its ends
/// are the radii that the lower and the upper ends of these would have, beside the share at the
/// first level as it is. An end at the last size may lie beyond it. std::nullopt if there is no
/// radius, or if shares have no interval.
std::optional<Interval> basin_radius_interval(const Sweep& sweep, const BasinRow& row);

/// The size of a level without the rounding error of equal steps.
double rounded_size(const Sweep& sweep, int level);

/// "deg" or "m".
const char* size_unit(const Sweep& sweep);

}  // namespace croon::experiments
