#include "framework/io/cloud_columns.hpp"

#include <algorithm>
#include <cstring>

namespace croon {
namespace {

/// The first number of point `i` in `column`.
double number(const CloudColumn& column, std::uint64_t i) {
  const char* const bytes = column.first + i * column.stride;
  // The common case. Memory is little-endian, see docs/design.md.
  if (column.type == scalar_type_of<float>() && column.order == ByteOrder::little) {
    float value = 0.0F;
    std::memcpy(&value, bytes, sizeof(value));
    return static_cast<double>(value);
  }
  return decode_scalar(column.type, column.order, bytes);
}

/// The channel of the points `kept`.
Channel channel_of(const CloudColumn& column, const std::vector<std::uint64_t>& kept) {
  Channel channel{column.name, column.type, column.count, {}};
  const std::size_t each = channel.bytes_per_point();
  channel.bytes.resize(kept.size() * each);
  char* to = channel.bytes.data();
  for (const std::uint64_t i : kept) {
    std::memcpy(to, column.first + i * column.stride, each);
    to += each;
  }
  if (column.order == ByteOrder::little || column.type.size == 1) return channel;
  for (std::size_t at = 0; at < channel.bytes.size(); at += column.type.size) {
    std::reverse(&channel.bytes[at], &channel.bytes[at] + column.type.size);
  }
  return channel;
}

}  // namespace

LoadedCloud from_columns(LoadedCloud cloud, std::uint64_t points,
                         const std::array<CloudColumn, 3>& xyz,
                         const std::vector<CloudColumn>& channels) {
  cloud.points.reserve(cloud.points.size() + points);
  std::vector<std::uint64_t> kept;
  kept.reserve(points);
  for (std::uint64_t i = 0; i < points; ++i) {
    if (cloud.add({number(xyz[0], i), number(xyz[1], i), number(xyz[2], i)})) kept.push_back(i);
  }
  for (const CloudColumn& column : channels) cloud.channels.push_back(channel_of(column, kept));
  return cloud;
}

}  // namespace croon
