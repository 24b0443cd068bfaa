#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// One message of a topic: when it was measured, and its cloud on demand.
struct RecordedCloud {
  double stamp_s = 0.0;  ///< Of the header; of the recording if the header has none.
  /// Throws InputError if the message is damaged.
  std::function<LoadedCloud()> load;
};

/// A topic of a recording with sensor_msgs/msg/PointCloud2.
struct CloudTopic {
  std::string name;                   ///< "/top/points".
  std::string frame;                  ///< frame_id of the first message; may be empty.
  std::vector<RecordedCloud> clouds;  ///< In order of time.
};

/// Whether the path looks like a recording: a file that begins like MCAP or a bag of ROS 1 or is
/// called .db3, .mcap, .bag (or the first two with .zstd, .zst or .lz4), or a folder with
/// such files or the metadata.yaml of a rosbag2. read_recording says of each how it can be read.
bool is_recording(const std::filesystem::path& path);

/// The topics with point clouds, sorted by name. Reads headers and indices; clouds are read on
/// demand and the file must stay. If a file ends too early or is damaged behind clouds that can be
/// read, these are returned, with a sentence in `notices`; if that is null, it is an error. Throws
/// InputError: not a recording, a damaged one, no point clouds (naming the types that it has), ROS
/// 1 bags and compressed files (naming the way to convert them).
std::vector<CloudTopic> read_recording(const std::filesystem::path& path,
                                       std::vector<std::string>* notices = nullptr);

}  // namespace croon
