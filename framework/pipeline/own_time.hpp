#pragma once

#include <chrono>

#include "framework/spatial/once_table.hpp"

namespace croon {

/// Measures the time of a step on this thread, excluding the shared work (see OnceTable) that the
/// thread does or waits for meanwhile. Shared work that other threads do for a step that processes
/// several scenes in parallel is included.
class OwnTime {
 public:
  /// Seconds since the construction.
  double seconds() const {
    const double wall_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return wall_s - (seconds_spent_on_shared_work() - shared_before_s_);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double shared_before_s_ = seconds_spent_on_shared_work();
};

}  // namespace croon
