#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// One message of a topic: its time stamp, and its cloud on demand.
struct RecordedCloud {
  double stamp_s = 0.0;  ///< From the header, or the recording time if the header has none.
  /// Throws InputError if the message is damaged.
  std::function<LoadedCloud()> load;
};

/// A topic of a recording with sensor_msgs/msg/PointCloud2.
struct CloudTopic {
  std::string name;                   ///< "/top/points".
  std::string frame;                  ///< frame_id of the first message; may be empty.
  std::vector<RecordedCloud> clouds;  ///< In temporal order.
};

/// Whether the path looks like a recording: a file that begins like MCAP or a ROS 1 bag or has the
/// suffix .db3, .mcap or .bag (the first two also with .zstd, .zst or .lz4), or a folder with such
/// files or the metadata.yaml of a rosbag2. For unsupported ones, read_recording reports how to
/// convert them.
bool is_recording(const std::filesystem::path& path);

/// Reads the topics with point clouds, sorted by name. Only headers and indices are read; clouds
/// are read on demand, so the file must persist. If a file ends too early or is damaged after
/// readable clouds, these are returned with a sentence in `notices`; if that is null, it is an
/// error. Throws InputError if the path is not a recording, is damaged or has no point clouds
/// (listing the types that it has), and for ROS 1 bags and compressed files (with a way to convert
/// them).
std::vector<CloudTopic> read_recording(const std::filesystem::path& path,
                                       std::vector<std::string>* notices = nullptr);

}  // namespace croon
