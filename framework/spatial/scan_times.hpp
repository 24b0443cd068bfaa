#pragma once

#include <string>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// Whether the channel `time` of a cloud is usable for correcting motion.
struct TimeCheck {
  bool has_times = false;  ///< Whether the cloud has the channel at all.
  bool is_usable = false;
  std::string reason;  ///< Why it is not usable, such as "all times are equal"; otherwise empty.
};

/// Checks whether the times of one scan are missing, all equal, not finite, too long or short for a
/// scan, decreasing, or unrelated to the directions of its points.
TimeCheck check_times(const PointCloud& cloud);

/// Why the times of the clouds of one scene cannot be used together although each is usable: the
/// clocks have different epochs, or the scans are too far apart in time. Empty if they can. `names`
/// has the sensors in the order of `clouds`, the reference first.
std::string why_not_one_clock(const std::vector<std::string>& names,
                              const std::vector<const PointCloud*>& clouds);

}  // namespace croon
