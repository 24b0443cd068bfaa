#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "framework/base/error.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The header of a message (std_msgs/msg/Header).
struct MessageHeader {
  double stamp_s = 0.0;  ///< Since 1970, or since the sensor was started.
  std::string frame;     ///< frame_id.
};

/// Reads the header of a message in CDR from `head`, its first bytes; std::nullopt if the header is
/// incomplete there. The frame is empty if `head` ends inside it.
std::optional<MessageHeader> read_message_header(std::string_view head);

/// Reads the cloud in a sensor_msgs/msg/PointCloud2 message in CDR: coordinates and channels of any
/// of its eight datatypes, in either byte order, with or without padding, organized or not. Points
/// are dropped and counted as in LoadedCloud::add. The channel `time` is in seconds on the clock of
/// `stamp_s`, the stamp of the message (see time_offset_s). `place` is the position for errors.
/// Throws InputError if the message is damaged or has no x, y, z.
LoadedCloud read_point_cloud2(std::string_view message, double stamp_s, const Fault& place);

}  // namespace croon
