#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace croon {

/// Number of bytes of a message that are read when a recording is opened: its header with the
/// frame.
constexpr std::size_t kMessageHeadBytes = 256;

/// One message as stored in its recording.
struct StoredMessage {
  double log_time_s = 0.0;  ///< Recording time since 1970.
  std::string head;         ///< Its first kMessageHeadBytes.
  /// Reads the whole message. Throws InputError if it is damaged, UnavailableFile if the file is
  /// gone.
  std::function<std::string()> read;
  std::filesystem::path file = {};
};

/// A topic with clouds in CDR.
struct StoredTopic {
  std::string name;
  std::vector<StoredMessage> messages;  ///< In the order of the file.
};

/// The topics with clouds in one or more files, and the types of their other topics.
struct StoredTopics {
  std::vector<StoredTopic> clouds;
  std::set<std::string> other_types;

  /// The topic `name`, which is added if it is new.
  StoredTopic& cloud_topic(const std::string& name);
};

/// Whether `type` is that of PointCloud2 messages, in the current or the original spelling of ROS
/// 2.
bool is_cloud_type(const std::string& type);

/// A recording ends too early or is damaged. Everything before the damage was read.
class DamagedRecording : public InputError {
 public:
  using InputError::InputError;
};

/// Adds the messages with clouds in an MCAP file (mcap.dev) to `topics`; chunks are optional and
/// may be compressed with lz4 or zstd. Reads the file from its start without an index. Throws
/// DamagedRecording; InputError if the file is not MCAP or its clouds are not in CDR.
void read_mcap(const std::filesystem::path& file, StoredTopics& topics);

/// The same for the SQLite file of a rosbag2 (.db3).
void read_rosbag_sqlite(const std::filesystem::path& file, StoredTopics& topics);

}  // namespace croon
