#include "framework/spatial/deskew.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/time_unit.hpp"

namespace croon {

Points deskewed(const Points& points, const std::vector<double>& times_s, const Twist& velocity,
                double reference_s) {
  Points moved;
  moved.reserve(points.size());
  RigidTransform T_reference_now;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // All rings fire simultaneously; in most clouds their points are consecutive.
    if (i == 0 || times_s[i] != times_s[i - 1]) {
      T_reference_now = motion_over(velocity, times_s[i] - reference_s);
    }
    moved.push_back((T_reference_now * points[i].cast<double>()).cast<float>());
  }
  return moved;
}

PointCloud deskewed(PointCloud cloud, const std::vector<double>& times_s, const Twist& velocity,
                    double reference_s) {
  cloud.points = deskewed(cloud.points, times_s, velocity, reference_s);
  return cloud;
}

TimeSpan span_of(const std::vector<double>& times_s) {
  const auto [first, last] = std::minmax_element(times_s.begin(), times_s.end());
  return {*first, *last};
}

void require_near(const std::vector<double>& times_s, double reference_s) {
  constexpr double kMaxTimeOffset_s = 60.0;
  for (const double time_s : times_s) {
    if (std::abs(time_s - reference_s) <= kMaxTimeOffset_s) continue;
    if (!std::isfinite(time_s) || !std::isfinite(reference_s)) {
      throw StageError("a point's time is not a finite number");
    }
    throw StageError("a point's time is more than " + fixed_number(kMaxTimeOffset_s, 0) +
                     " s from the reference time: is it relative to the scan (reference_time)?");
  }
  if (times_s.empty()) return;
  const TimeSpan span = span_of(times_s);
  const double length_s = span.last_s - span.first_s;
  if (length_s > 0.0 && length_s < kMinScan_s && times_s.size() >= kMinPointsOfScan) {
    throw StageError("the scan lasts less than " + fixed_number(1e3 * kMinScan_s, 1) +
                     " ms: are its times those of a scan?");
  }
  if (length_s <= kMaxScan_s) return;
  throw StageError("the scan lasts longer than " + fixed_number(kMaxScan_s, 0) +
                   " s: are its times those of one scan?");
}

}  // namespace croon
