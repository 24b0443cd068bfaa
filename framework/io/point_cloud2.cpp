#include "framework/io/point_cloud2.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "framework/io/cdr.hpp"
#include "framework/io/channel_names.hpp"
#include "framework/io/common_offset.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/point_times.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

struct CloudField {
  std::string name;
  std::uint64_t offset = 0;  ///< In a point, bytes.
  ScalarType type;
  std::uint64_t count = 1;  ///< Numbers per point.
};

/// A message, with its points as stored.
struct CloudMessage {
  std::uint64_t height = 0, width = 0;
  std::vector<CloudField> fields;
  ByteOrder order = ByteOrder::little;
  std::uint64_t point_step = 0, row_step = 0;  ///< Bytes.
  std::string_view data;
};

/// The type of the number `datatype` in sensor_msgs/msg/PointField.
ScalarType type_of_datatype(std::uint8_t datatype, const std::string& field,
                            const CdrReader& reader) {
  static const std::array<ScalarType, 8> types = {{{ScalarKind::signed_integer, 1},
                                                   {ScalarKind::unsigned_integer, 1},
                                                   {ScalarKind::signed_integer, 2},
                                                   {ScalarKind::unsigned_integer, 2},
                                                   {ScalarKind::signed_integer, 4},
                                                   {ScalarKind::unsigned_integer, 4},
                                                   {ScalarKind::floating, 4},
                                                   {ScalarKind::floating, 8}}};
  if (datatype < 1 || datatype > types.size()) {
    reader.fail("expected a datatype from 1 to 8 for the field " + in_quotes(field) + ", found " +
                std::to_string(datatype));
  }
  return types[datatype - 1U];
}

MessageHeader read_header(CdrReader& reader) {
  MessageHeader header;
  const std::int32_t seconds = reader.read_int32();
  const std::uint32_t nanoseconds = reader.read_uint32();
  header.stamp_s = static_cast<double>(seconds) + static_cast<double>(nanoseconds) * 1e-9;
  return header;
}

std::vector<CloudField> read_cloud_fields(CdrReader& reader) {
  constexpr std::uint32_t kMaxFields = 256;
  constexpr std::size_t kMinFieldBytes = 16;
  const std::uint32_t count = reader.read_length(kMinFieldBytes);
  if (count > kMaxFields) reader.fail("has " + std::to_string(count) + " fields");
  std::vector<CloudField> fields(count);
  for (CloudField& field : fields) {
    field.name = std::string(reader.read_string());
    field.offset = reader.read_uint32();
    field.type = type_of_datatype(reader.read_uint8(), field.name, reader);
    // Some drivers set the count of single numbers to zero, which PCL accepts too.
    field.count = std::max<std::uint32_t>(reader.read_uint32(), 1);
  }
  return fields;
}

/// Throws InputError unless the points and all fields are within the data.
void check_layout(CloudMessage& cloud, const CdrReader& reader) {
  if (cloud.width == 0 || cloud.height == 0) return;
  for (const CloudField& field : cloud.fields) {
    const std::uint64_t end = field.offset + field.count * field.type.size;
    if (end <= cloud.point_step) continue;
    reader.fail("expected the field " + in_quotes(field.name) + " within the " +
                std::to_string(cloud.point_step) + " bytes of a point, found its end at byte " +
                std::to_string(end));
  }
  const std::uint64_t row_bytes = cloud.width * cloud.point_step;
  // Some drivers do not set the step of a single row or of rows without padding.
  const bool is_packed =
      cloud.data.size() / cloud.height == row_bytes && cloud.data.size() % cloud.height == 0;
  if (cloud.height == 1 || is_packed) cloud.row_step = row_bytes;
  const bool is_complete = cloud.row_step >= row_bytes && row_bytes > 0 &&
                           cloud.data.size() >= row_bytes &&
                           (cloud.data.size() - row_bytes) / cloud.row_step >= cloud.height - 1;
  if (is_complete) return;
  reader.fail("expected " + std::to_string(cloud.height) + " x " + std::to_string(cloud.width) +
              " points of " + std::to_string(cloud.point_step) + " bytes, found " +
              std::to_string(cloud.data.size()) + " bytes with a row_step of " +
              std::to_string(cloud.row_step));
}

CloudMessage read_cloud_message(CdrReader& reader) {
  CloudMessage cloud;
  read_header(reader);
  reader.read_string();  // frame_id
  cloud.height = reader.read_uint32();
  cloud.width = reader.read_uint32();
  cloud.fields = read_cloud_fields(reader);
  cloud.order = reader.read_bool() ? ByteOrder::big : ByteOrder::little;
  cloud.point_step = reader.read_uint32();
  cloud.row_step = reader.read_uint32();
  cloud.data = reader.read_octets();
  reader.read_bool();  // is_dense: not needed, since points are checked.
  reader.expect_end();
  check_layout(cloud, reader);
  return cloud;
}

const CloudField& coordinate_field(const CloudMessage& cloud, const std::string& name,
                                   const CdrReader& reader) {
  const CloudField* found = nullptr;
  std::string names;
  for (const CloudField& field : cloud.fields) {
    names += (names.empty() ? "" : ", ") + field.name;
    if (field.name != name) continue;
    if (found != nullptr) reader.fail("duplicate field " + in_quotes(name));
    found = &field;
  }
  if (found == nullptr) {
    reader.fail("expected the fields x, y and z, found " + (names.empty() ? "none" : names));
  }
  if (found->count != 1) reader.fail("expected one number in the field " + in_quotes(name));
  return *found;
}

/// Appends the numbers of `field` of the point at `point`, little-endian.
void append_numbers(std::string& bytes, const CloudField& field, ByteOrder order,
                    const char* point) {
  const char* const begin = point + field.offset;
  const std::size_t size = field.type.size;
  const std::size_t end = bytes.size() + field.count * size;
  bytes.append(begin, field.count * size);
  if (order == ByteOrder::little || size == 1) return;
  for (std::size_t at = end - field.count * size; at < end; at += size) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
  }
}

LoadedCloud cloud_of(const CloudMessage& message, const CdrReader& reader,
                     const Eigen::Vector3d& origin_m) {
  LoadedCloud cloud;
  cloud.origin_m = origin_m;
  std::array<const CloudField*, 3> xyz{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    xyz[axis] = &coordinate_field(message, std::string(1, "xyz"[axis]), reader);
  }
  std::vector<std::string> names;
  for (const CloudField& field : message.fields) names.push_back(field.name);
  names = channel_names(names);
  std::vector<const CloudField*> sources;
  const std::uint64_t points = message.height * message.width;
  cloud.points.reserve(points);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    const CloudField& field = message.fields[i];
    sources.push_back(&field);
    cloud.channels.push_back({names[i], field.type, field.count, {}});
    cloud.channels.back().bytes.reserve(points * field.count * field.type.size);
  }
  for (std::uint64_t i = 0; i < points; ++i) {
    const char* const point = message.data.data() + i / message.width * message.row_step +
                              i % message.width * message.point_step;
    const auto coordinate = [&](std::size_t axis) {
      return decode_scalar(xyz[axis]->type, message.order, point + xyz[axis]->offset);
    };
    if (!cloud.add({coordinate(0), coordinate(1), coordinate(2)})) continue;
    for (std::size_t c = 0; c < sources.size(); ++c) {
      append_numbers(cloud.channels[c].bytes, *sources[c], message.order, point);
    }
  }
  return cloud;
}

}  // namespace

std::optional<MessageHeader> read_message_header(std::string_view head) {
  MessageHeader header;
  try {
    CdrReader reader(head, {});
    header = read_header(reader);
    try {
      header.frame = std::string(reader.read_string());
    } catch (const InputError&) {
      // `head` ends inside the frame.
    }
  } catch (const InputError&) {
    return std::nullopt;
  }
  return header;
}

LoadedCloud read_point_cloud2(std::string_view message, double stamp_s, const Fault& place) {
  CdrReader reader(message, place);
  const CloudMessage stored = read_cloud_message(reader);
  LoadedCloud cloud = without_common_offset(
      [&](const Eigen::Vector3d& origin_m) { return cloud_of(stored, reader, origin_m); });
  check_unit_of_times(cloud);
  convert_times(cloud, stamp_s);
  cloud.sha256 = sha256_of_text(message);
  return cloud;
}

}  // namespace croon
