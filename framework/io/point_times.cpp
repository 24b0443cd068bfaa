#include "framework/io/point_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace croon {

double time_offset_s(double min_s, double max_s, double stamp_s) {
  constexpr double kMaxDistance_s = 10.0;
  const auto are_near = [&](double time_s) {
    return std::abs(min_s - time_s) < kMaxDistance_s && std::abs(max_s - time_s) < kMaxDistance_s;
  };
  return are_near(0.0) && !are_near(stamp_s) ? stamp_s : 0.0;
}

void convert_times(PointCloud& cloud, double stamp_s) {
  const Channel* const channel = find_channel(cloud, kTime);
  if (channel == nullptr || channel->count != 1) return;
  std::vector<double> times = times_s(cloud);
  double min_s = std::numeric_limits<double>::infinity();
  double max_s = -min_s;
  for (const double time_s : times) {
    if (!std::isfinite(time_s)) continue;
    min_s = std::min(min_s, time_s);
    max_s = std::max(max_s, time_s);
  }
  if (min_s > max_s) return;
  const double offset_s = time_offset_s(min_s, max_s, stamp_s);
  for (double& time_s : times) time_s += offset_s;
  set_channel(cloud, make_channel(kTime, times));
}

}  // namespace croon
