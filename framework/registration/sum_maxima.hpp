#pragma once

#include <array>
#include <functional>
#include <vector>

namespace croon {

/// Edge of a block of shifts.
inline constexpr int kBlock = 4;

/// Blocks along one axis of `window` shifts.
constexpr int blocks_along(int window) { return (window + kBlock - 1) / kBlock; }

/// The sums at the shifts of a block: (row, column) has the index `kBlock * column + row`.
using BlockOfSums = std::array<int, kBlock * kBlock>;

/// Sums at `window` x `window` shifts for each of several yaws, which are computed by blocks.
struct BlockedSums {
  int yaws = 0;
  int window = 0;
  /// Upper bounds of the sums in each block, by yaw, row of blocks and column of blocks; a block
  /// may extend beyond the window.
  std::vector<int> bounds;
  /// The sums in a block of the yaw (first argument), by its row and column of blocks.
  std::function<BlockOfSums(int, int, int)> sums_of;
};

/// A sum that is positive and not below those of the four neighbouring shifts.
struct SumMaximum {
  int sum = 0;
  int yaw = 0;
  int row = 0;
  int column = 0;
};

/// Passes the maxima to `visit` until it returns false: the largest first, equal ones in ascending
/// order of yaw, row and column. A block is computed only if its bound reaches the sum that is
/// visited: best-first branch and bound, after Hess et al., Real-time loop closure in 2D LIDAR
/// SLAM, ICRA 2016, with one level.
void visit_maxima(const BlockedSums& blocked, const std::function<bool(const SumMaximum&)>& visit);

}  // namespace croon
