#pragma once

#include <string>
#include <vector>

#include "framework/stage/dataset.hpp"

namespace croon {

/// Whether the channel `time` of a cloud can be used to correct its motion.
struct TimeCheck {
  bool has_times = false;  ///< Whether the cloud has the channel at all.
  bool is_usable = false;
  std::string reason;  ///< Why not, in words: "all times are equal"; empty if usable.
};

/// Checks the times of one scan by themselves and against the azimuths of its points: missing, all
/// equal, not finite, too long or short for a scan, or without relation to where the sensor looked.
TimeCheck check_times(const PointCloud& cloud);

/// Why the times of the clouds of one scene cannot be used together, given that each is usable: the
/// clocks have different epochs, or the scans do not overlap in time. Empty if they can. `names`
/// are those of the sensors, in the order of `clouds`, the reference first.
std::string why_not_one_clock(const std::vector<std::string>& names,
                              const std::vector<const PointCloud*>& clouds);

}  // namespace croon
