#include "framework/io/point_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace croon {
namespace {

constexpr double kUnits_s[] = {1.0, 1e-3, 1e-6, 1e-9};

// Consecutive units are a factor of 1000 apart, as are these bounds of the duration of a scan.
constexpr double kMinScan_s = 0.003;
constexpr double kMaxScan_s = 3.0;

/// The unit in which `max` is a time since 1970, between 2001 and 2286; 0 if there is none, as for
/// nanoseconds since a sensor was started, which may be as large but span more.
double unit_since_1970(double max, double span) {
  for (const double unit_s : kUnits_s) {
    const bool is_in_range = max * unit_s >= 1e9 && max * unit_s < 1e10;
    if (is_in_range && span * unit_s < kMaxScan_s) return unit_s;
  }
  return 0.0;
}

/// The unit of times of a scan that do not count from 1970.
double unit_of_scan(ScalarType type, double span) {
  for (const double unit_s : kUnits_s) {
    if (span * unit_s >= kMinScan_s && span * unit_s < kMaxScan_s) return unit_s;
  }
  if (span * kUnits_s[3] >= kMaxScan_s) return kUnits_s[3];
  return type.kind == ScalarKind::floating ? kUnits_s[0] : kUnits_s[3];
}

}  // namespace

TimeRule time_rule(ScalarType type, double min, double max, double stamp_s) {
  constexpr double kMaxOffset_s = 10.0;
  if (const double unit_s = unit_since_1970(max, max - min); unit_s > 0.0) return {unit_s, 0.0};
  const double unit_s = unit_of_scan(type, max - min);
  const auto is_near = [&](double time_s) {
    return std::abs(min * unit_s - time_s) < kMaxOffset_s &&
           std::abs(max * unit_s - time_s) < kMaxOffset_s;
  };
  const bool is_relative = is_near(0.0) && !is_near(stamp_s);
  return {unit_s, is_relative ? stamp_s : 0.0};
}

void convert_times(PointCloud& cloud, double stamp_s) {
  const Channel* const times = find_channel(cloud, kTime);
  if (times == nullptr || times->count != 1 || cloud.empty()) return;
  std::vector<double> values = channel_values(cloud, kTime);
  double min = std::numeric_limits<double>::infinity();
  double max = -min;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    min = std::min(min, value);
    max = std::max(max, value);
  }
  if (min > max) return;
  const TimeRule rule = time_rule(times->type, min, max, stamp_s);
  for (double& value : values) value = rule.offset_s + rule.unit_s * value;
  set_channel(cloud, make_channel(kTime, values));
}

}  // namespace croon
