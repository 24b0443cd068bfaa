#include "framework/geometry/time_unit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace croon {
namespace {

constexpr TimeUnit kUnits[] = {TimeUnit::seconds, TimeUnit::milliseconds, TimeUnit::microseconds,
                               TimeUnit::nanoseconds};

/// The minimum and the maximum of the finite times.
struct Range {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  double length() const { return max - min; }
};

Range range_of(const std::vector<double>& times) {
  Range range;
  for (const double time : times) {
    if (!std::isfinite(time)) continue;
    range.min = std::min(range.min, time);
    range.max = std::max(range.max, time);
  }
  return range;
}

}  // namespace

double seconds_of(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::seconds:
      return 1.0;
    case TimeUnit::milliseconds:
      return 1e-3;
    case TimeUnit::microseconds:
      return 1e-6;
    case TimeUnit::nanoseconds:
      return 1e-9;
  }
  throw std::logic_error("seconds_of: no such unit");
}

const char* name_of(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::seconds:
      return "seconds";
    case TimeUnit::milliseconds:
      return "milliseconds";
    case TimeUnit::microseconds:
      return "microseconds";
    case TimeUnit::nanoseconds:
      return "nanoseconds";
  }
  throw std::logic_error("name_of: no such unit");
}

TimeUnit convention_of(ScalarKind kind) {
  return kind == ScalarKind::floating ? TimeUnit::seconds : TimeUnit::nanoseconds;
}

TimeUnit unit_of_times(const std::vector<double>& times, ScalarKind kind) {
  const TimeUnit convention = convention_of(kind);
  const Range range = range_of(times);
  if (!(range.length() >= 0.0)) return convention;
  const bool is_scan = times.size() >= kMinPointsOfScan;
  const auto is_possible = [&](TimeUnit unit) {
    const double length_s = range.length() * seconds_of(unit);
    return length_s <= kMaxScan_s && (length_s >= kMinScan_s || !is_scan);
  };
  // From 2001 to 2096. A scan may be shorter here, because the clock may have been stopped.
  constexpr double kMinEpoch_s = 1e9, kMaxEpoch_s = 4e9;
  for (const TimeUnit unit : kUnits) {
    const double one_s = seconds_of(unit);
    const bool is_epoch = range.min * one_s >= kMinEpoch_s && range.max * one_s <= kMaxEpoch_s;
    // 32-bit integers can represent nanoseconds of scans of up to four seconds.
    const bool is_certain = unit != TimeUnit::seconds || kind == ScalarKind::floating;
    if (is_epoch && is_certain && range.length() * one_s <= kMaxScan_s) return unit;
  }
  if (is_possible(convention) || range.length() == 0.0) return convention;
  constexpr double kUsualScan_s = 0.1;
  TimeUnit best = convention;
  double best_ratio = std::numeric_limits<double>::infinity();
  for (const TimeUnit unit : kUnits) {
    if (!is_possible(unit)) continue;
    const double ratio = std::abs(std::log(range.length() * seconds_of(unit) / kUsualScan_s));
    if (ratio >= best_ratio) continue;
    best = unit;
    best_ratio = ratio;
  }
  return best;
}

bool restart_in_packets(const std::vector<double>& times, ScalarKind kind) {
  constexpr std::size_t kMinRestarts = 10;
  if (times.size() < kMinPointsOfScan) return false;
  const Range range = range_of(times);
  if (!(range.length() > 0.0)) return false;
  std::size_t restarts = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i - 1] - times[i] > 0.5 * range.length()) ++restarts;
  }
  // A scan that is stored ring by ring has about as many restarts, one per ring.
  if (restarts < kMinRestarts) return false;
  const auto is_packet = [&](TimeUnit unit) {
    constexpr double kMinPacket_s = 2.5e-4, kMaxPacket_s = 0.01;
    const double length_s = range.length() * seconds_of(unit);
    return length_s >= kMinPacket_s && length_s < kMaxPacket_s;
  };
  const TimeUnit convention = convention_of(kind);
  if (is_packet(convention)) return true;
  const double length_s = range.length() * seconds_of(convention);
  if (length_s >= kMinScan_s && length_s <= kMaxScan_s) return false;
  return std::any_of(std::begin(kUnits), std::end(kUnits), is_packet);
}

}  // namespace croon
