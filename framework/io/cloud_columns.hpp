#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/base/scalar_type.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The numbers of one field of a binary cloud in memory: `count` per point, starting at `first`,
/// with `stride` bytes from one point to the next.
struct CloudColumn {
  std::string name;  ///< Of the channel.
  ScalarType type;
  std::size_t count = 1;
  const char* first = nullptr;
  std::size_t stride = 0;
  ByteOrder order = ByteOrder::little;
};

/// Adds `points` points to `cloud`, whose coordinates are the first numbers of the columns `xyz`,
/// and the given channels. The memory must contain all of them.
LoadedCloud from_columns(LoadedCloud cloud, std::uint64_t points,
                         const std::array<CloudColumn, 3>& xyz,
                         const std::vector<CloudColumn>& channels);

}  // namespace croon
