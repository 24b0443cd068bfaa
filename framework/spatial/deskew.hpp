#pragma once

#include <vector>

#include "framework/geometry/point_cloud.hpp"
#include "framework/geometry/twist.hpp"

namespace croon {

/// The points of one scan, measured at `times_s` by a sensor with the constant `velocity` (in the
/// sensor's own frame), moved to where the sensor would have measured them at the time
/// `reference_s`: `p -> T(reference, t) p` (Zhang and Singh, LOAM, 2014, section V.B). One time per
/// point, seconds.
Points deskewed(const Points& points, const std::vector<double>& times_s, const Twist& velocity,
                double reference_s);

/// The same for a cloud; its channels stay.
PointCloud deskewed(PointCloud cloud, const std::vector<double>& times_s, const Twist& velocity,
                    double reference_s);

/// The first and the last of `times_s`, which must not be empty.
struct TimeSpan {
  double first_s = 0.0;
  double last_s = 0.0;
  double middle_s() const { return 0.5 * (first_s + last_s); }
};
TimeSpan span_of(const std::vector<double>& times_s);

/// Throws StageError if `times_s` cannot belong to a scan: a time is not finite or far from
/// `reference_s`, or the span of the times is too long or too short for a scan.
void require_near(const std::vector<double>& times_s, double reference_s);

}  // namespace croon
