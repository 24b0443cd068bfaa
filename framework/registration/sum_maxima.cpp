#include "framework/registration/sum_maxima.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace croon {
namespace {

class BestFirst {
 public:
  explicit BestFirst(const BlockedSums& blocked)
      : blocked_(blocked),
        stride_(kBlock * blocks_along(blocked.window) + 2),
        sums_(static_cast<std::size_t>(blocked.yaws)) {
    for (std::size_t i = 0; i < blocked.bounds.size(); ++i) {
      if (blocked.bounds[i] > 0)
        items_.push_back(item(blocked.bounds[i], true, static_cast<int>(i)));
    }
    std::make_heap(items_.begin(), items_.end());
  }

  void visit(const std::function<bool(const SumMaximum&)>& visit) {
    while (!items_.empty()) {
      std::pop_heap(items_.begin(), items_.end());
      const std::uint64_t best = items_.back();
      items_.pop_back();
      const int index = kMaxIndex - static_cast<int>(best & kMaxIndex);
      if ((best & kIsBlock) != 0) {
        compute(index);
        continue;
      }
      const int window = blocked_.window;
      const SumMaximum maximum = {static_cast<int>(best >> 32), index / (window * window),
                                  index / window % window, index % window};
      // All larger sums are known by now.
      if (is_maximum(maximum) && !visit(maximum)) return;
    }
  }

 private:
  // A block with its bound or a shift with its sum, as a number whose order is that of the visits.
  // Blocks precede shifts with a sum equal to their bound, because they may contain another one.
  static constexpr int kMaxIndex = std::numeric_limits<std::int32_t>::max();
  static constexpr std::uint64_t kIsBlock = std::uint64_t{1} << 31;
  static std::uint64_t item(int sum, bool is_block, int index) {
    return static_cast<std::uint64_t>(sum) << 32 | (is_block ? kIsBlock : 0) |
           static_cast<std::uint64_t>(kMaxIndex - index);
  }

  /// The sum at a shift; the lowest number outside the window and in blocks that are not computed.
  int& at(int yaw, int row, int column) {
    return sums_[static_cast<std::size_t>(yaw)][(row + 1) * stride_ + column + 1];
  }

  bool is_maximum(const SumMaximum& shift) {
    const int* const sum = &at(shift.yaw, shift.row, shift.column);
    return sum[-stride_] <= *sum && sum[stride_] <= *sum && sum[-1] <= *sum && sum[1] <= *sum;
  }

  /// Computes a block and adds those of its shifts that may be maxima.
  void compute(int block) {
    const int blocks = blocks_along(blocked_.window);
    const int window = blocked_.window;
    const int yaw = block / (blocks * blocks);
    const int block_row = block / blocks % blocks;
    const int block_column = block % blocks;
    std::vector<int>& sums = sums_[static_cast<std::size_t>(yaw)];
    if (sums.empty()) {
      sums.assign(stride_ * stride_, std::numeric_limits<int>::lowest());
    }
    const int rows = std::min(kBlock, window - kBlock * block_row);
    const int columns = std::min(kBlock, window - kBlock * block_column);
    const BlockOfSums here = blocked_.sums_of(yaw, block_row, block_column);
    const auto for_each_shift = [&](auto&& use) {
      for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
          use(SumMaximum{here[kBlock * column + row], yaw, kBlock * block_row + row,
                         kBlock * block_column + column});
        }
      }
    };
    for_each_shift(
        [&](const SumMaximum& shift) { at(shift.yaw, shift.row, shift.column) = shift.sum; });
    for_each_shift([&](const SumMaximum& shift) {
      if (shift.sum <= 0 || !is_maximum(shift)) return;
      items_.push_back(
          item(shift.sum, false, (shift.yaw * window + shift.row) * window + shift.column));
      std::push_heap(items_.begin(), items_.end());
    });
  }

  const BlockedSums& blocked_;
  int stride_;                          ///< Of a row of sums, with a border on both sides.
  std::vector<std::vector<int>> sums_;  ///< By yaw; empty if none of its blocks is computed.
  std::vector<std::uint64_t> items_;    ///< A heap.
};

}  // namespace

void visit_maxima(const BlockedSums& blocked, const std::function<bool(const SumMaximum&)>& visit) {
  BestFirst(blocked).visit(visit);
}

}  // namespace croon
