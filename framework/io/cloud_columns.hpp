#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/base/scalar_type.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The numbers of one field of a binary cloud in memory: `count` of them per point, from `first`
/// on, those of the next point `stride` bytes later.
struct CloudColumn {
  std::string name;  ///< Of the channel.
  ScalarType type;
  std::size_t count = 1;
  const char* first = nullptr;
  std::size_t stride = 0;
  ByteOrder order = ByteOrder::little;
};

/// `cloud` with `points` points more, whose coordinates are the first numbers of `xyz`, and with
/// these channels. The memory must hold all of them.
LoadedCloud from_columns(LoadedCloud cloud, std::uint64_t points,
                         const std::array<CloudColumn, 3>& xyz,
                         const std::vector<CloudColumn>& channels);

}  // namespace croon
