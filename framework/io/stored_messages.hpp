#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace croon {

/// The bytes of a message that are read when a recording is opened: its header, with the frame.
constexpr std::size_t kMessageHeadBytes = 256;

/// One message as its recording stores it.
struct StoredMessage {
  double log_time_s = 0.0;  ///< When it was recorded, since 1970.
  std::string head;         ///< Its first kMessageHeadBytes.
  /// All of it. Throws InputError if it is damaged, UnavailableFile if the file is gone.
  std::function<std::string()> read;
  std::filesystem::path file = {};
};

/// A topic with clouds in CDR.
struct StoredTopic {
  std::string name;
  std::vector<StoredMessage> messages;  ///< In the order of the file.
};

/// The topics with clouds of one or more files, and the types of their other topics.
struct StoredTopics {
  std::vector<StoredTopic> clouds;
  std::set<std::string> other_types;

  /// The topic called `name`, which is added if it is new.
  StoredTopic& cloud_topic(const std::string& name);
};

/// Whether `type` is that of messages with a cloud, as ROS 2 writes it now or wrote it at first.
bool is_cloud_type(const std::string& type);

/// A recording ends too early or is damaged. What precedes the damage was read.
class DamagedRecording : public InputError {
 public:
  using InputError::InputError;
};

/// Adds the messages with clouds of an MCAP file (mcap.dev) to `topics`: in chunks without
/// compression, with lz4 or zstd, or without chunks. Reads the file from its start and needs no
/// index. Throws DamagedRecording; InputError if the file is not MCAP or its clouds are not in CDR.
void read_mcap(const std::filesystem::path& file, StoredTopics& topics);

/// The same for the SQLite file of a rosbag2 (.db3).
void read_rosbag_sqlite(const std::filesystem::path& file, StoredTopics& topics);

}  // namespace croon
