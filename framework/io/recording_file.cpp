#include "framework/io/recording_file.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <limits>
#include <optional>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/decompress.hpp"
#include "framework/io/point_cloud2.hpp"
#include "framework/io/stored_messages.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

enum class Storage { none, mcap, sqlite, compressed, ros1 };

std::string lower_case_name(const fs::path& path) {
  std::string name = path.filename().string();
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

bool has_ending(const std::string& name, const std::string& ending) {
  return name.size() > ending.size() &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

/// The storage format of a file, by its first bytes or else by its name.
Storage storage_of(const fs::path& path) {
  std::string head(16, '\0');
  std::error_code error;
  if (fs::is_regular_file(path, error)) {
    std::ifstream stream(path, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  }
  const auto begins_with = [&](std::string_view bytes) {
    return head.compare(0, bytes.size(), bytes) == 0;
  };
  const std::string name = lower_case_name(path);
  if (begins_with("\x89MCAP")) return Storage::mcap;
  if (begins_with("#ROSBAG") || has_ending(name, ".bag")) return Storage::ros1;
  for (const char* inner : {".db3", ".mcap"}) {
    for (const char* outer : {".zstd", ".zst", ".lz4"}) {
      if (has_ending(name, std::string(inner) + outer)) return Storage::compressed;
    }
  }
  if (has_ending(name, ".mcap")) return Storage::mcap;
  return has_ending(name, ".db3") ? Storage::sqlite : Storage::none;
}

/// The path without its compression suffix.
fs::path decompressed_path(const fs::path& path) { return path.parent_path() / path.stem(); }

/// The names after "relative_file_paths:" in the metadata.yaml of a rosbag2; std::nullopt if there
/// are none.
std::optional<std::vector<std::string>> files_in_metadata(const fs::path& folder) {
  constexpr std::size_t kMaxBytes = 16 << 20;
  std::ifstream stream(folder / "metadata.yaml", std::ios::binary);
  if (!stream) return std::nullopt;
  std::string text(kMaxBytes, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.find("rosbag2_bagfile_information") == std::string::npos) return std::nullopt;
  std::vector<std::string> files;
  bool is_in_list = false;
  for (LineReader lines(text); lines.next();) {
    std::string_view line = trimmed(lines.line());
    if (line.substr(0, 2) != "- ") {
      is_in_list = line == "relative_file_paths:";
    } else if (is_in_list) {
      line = trimmed(line.substr(2));
      const bool is_quoted = line.size() > 1 && (line[0] == '"' || line[0] == '\'');
      if (is_quoted) line = line.substr(1, line.size() - 2);
      files.emplace_back(line);
    }
  }
  return files;
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// The files with messages in the folder of a recording, sorted by name.
std::vector<fs::path> files_in_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const Storage storage = storage_of(at->path());
    const bool is_stored =
        storage == Storage::mcap || storage == Storage::sqlite || storage == Storage::compressed;
    if (!is_stored || !is_file(at->path())) continue;
    // Skips a compressed file if its decompressed version exists.
    if (storage == Storage::compressed && is_file(decompressed_path(at->path()))) continue;
    files.push_back(at->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The files of a recording. Throws InputError if a file that its metadata.yaml lists is missing.
std::vector<fs::path> files_of_recording(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  std::vector<fs::path> files;
  for (const std::string& name : files_in_metadata(path).value_or(std::vector<std::string>{})) {
    // Early versions prefixed the name of the folder.
    fs::path file = path / fs::path(name).filename();
    if (storage_of(file) == Storage::compressed && is_file(decompressed_path(file))) {
      file = decompressed_path(file);
    }
    if (!is_file(file)) {
      throw InputError((path / "metadata.yaml").string(), "",
                       "expected the file " + in_quotes(name) + " beside it, found " +
                           found_instead_of_file(file) +
                           "; pass the existing files instead of the folder");
    }
    files.push_back(file);
  }
  if (files.empty()) files = files_in_folder(path);
  if (!files.empty()) return files;
  throw InputError(path.string(), "", "expected a recording (.db3 or .mcap), found none");
}

std::string decompression_command(const fs::path& file) {
  const bool is_lz4 = has_ending(lower_case_name(file), ".lz4");
  return (is_lz4 ? "lz4 -d " : "zstd -d ") + file.filename().string() + (is_lz4 ? " " : " -o ") +
         decompressed_path(file).filename().string();
}

void read_stored(const fs::path& file, StoredTopics& topics) {
  switch (storage_of(file)) {
    case Storage::mcap:
      return read_mcap(file, topics);
    case Storage::sqlite:
      return read_rosbag_sqlite(file, topics);
    case Storage::compressed:
      throw InputError(file.string(), "",
                       "is compressed as a whole; decompress it with " +
                           in_quotes(decompression_command(file)) +
                           " and pass the same path again, or the resulting file");
    case Storage::ros1:
      throw InputError(file.string(), "",
                       "is a recording of ROS 1; convert it with " +
                           in_quotes("rosbags-convert --src " + file.filename().string() +
                                     " --dst " + file.stem().string()) +
                           " and pass the folder");
    case Storage::none:
      break;
  }
  throw InputError(file.string(), "",
                   "expected a recording (a folder of rosbag2, .db3 or .mcap), found " +
                       (is_file(file) ? "another file" : found_instead_of_file(file)));
}

/// Advice for messages with points of another type; empty if there is none.
std::string advice_for_type(const std::string& type) {
  const auto has = [&](const char* word) { return type.find(word) != std::string::npos; };
  if (has("livox") && has("CustomMsg")) {
    return "; the Livox driver publishes PointCloud2 instead if its parameter xfer_format is 0; "
           "play this recording through livox_to_pointcloud2 and record the output";
  }
  for (const char* word : {"Packet", "VelodyneScan", "PandarScan", "RslidarScan", "UdpFrame"}) {
    if (!has(word)) continue;
    return "; play the packets of " + type +
           " to the driver of the sensor and record the clouds that it publishes";
  }
  if (!has("CompressedPointCloud2")) return "";
  return "; republish the clouds with point_cloud_transport and record them";
}

[[noreturn]] void fail_without_clouds(const fs::path& path, const StoredTopics& topics) {
  if (!topics.clouds.empty()) {
    throw InputError(path.string(), "", "has topics with point clouds, but no message of them");
  }
  std::string types, advice;
  for (const std::string& type : topics.other_types) {
    types += (types.empty() ? "" : ", ") + type;
    if (advice.empty()) advice = advice_for_type(type);
  }
  throw InputError(path.string(), "",
                   "expected a topic with sensor_msgs/msg/PointCloud2, found " +
                       (types.empty() ? "no topic" : types) + advice);
}

/// The message as published; rosbag2 may compress each message individually.
std::string published(std::string bytes, const Fault& place) {
  if (!is_zstd(bytes)) return bytes;
  return decompress_zstd(bytes, std::numeric_limits<std::uint32_t>::max(), place);
}

RecordedCloud recorded_cloud(const StoredMessage& message, const Fault& place, std::string& frame) {
  std::optional<MessageHeader> header;
  // A damaged message has no header; the error is reported when it is loaded.
  try {
    header = read_message_header(is_zstd(message.head) ? published(message.read(), place)
                                                       : message.head);
  } catch (const UnavailableFile&) {
    throw;
  } catch (const InputError&) {
  }
  const bool has_stamp = header && header->stamp_s != 0.0;
  const double stamp_s = has_stamp ? header->stamp_s : message.log_time_s;
  if (header && frame.empty()) frame = header->frame;
  return {stamp_s, [read = message.read, stamp_s, place] {
            return read_point_cloud2(published(read(), place), stamp_s, place);
          }};
}

CloudTopic cloud_topic(const StoredTopic& stored) {
  CloudTopic topic{stored.name, "", {}};
  for (std::size_t i = 0; i < stored.messages.size(); ++i) {
    const StoredMessage& message = stored.messages[i];
    const Fault place{
        message.file.string(), stored.name + ", message " + std::to_string(i + 1), "", {}};
    topic.clouds.push_back(recorded_cloud(message, place, topic.frame));
  }
  std::stable_sort(
      topic.clouds.begin(), topic.clouds.end(),
      [](const RecordedCloud& a, const RecordedCloud& b) { return a.stamp_s < b.stamp_s; });
  return topic;
}

std::size_t message_count(const StoredTopics& topics) {
  std::size_t count = 0;
  for (const StoredTopic& topic : topics.clouds) count += topic.messages.size();
  return count;
}

}  // namespace

StoredTopic& StoredTopics::cloud_topic(const std::string& name) {
  for (StoredTopic& topic : clouds) {
    if (topic.name == name) return topic;
  }
  return clouds.emplace_back(StoredTopic{name, {}});
}

bool is_cloud_type(const std::string& type) {
  return type == "sensor_msgs/msg/PointCloud2" || type == "sensor_msgs/PointCloud2";
}

bool is_recording(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return storage_of(path) != Storage::none;
  return files_in_metadata(path).has_value() || !files_in_folder(path).empty();
}

std::vector<CloudTopic> read_recording(const fs::path& path, std::vector<std::string>* notices) {
  StoredTopics stored;
  for (const fs::path& file : files_of_recording(path)) {
    const std::size_t before = message_count(stored);
    try {
      read_stored(file, stored);
    } catch (const DamagedRecording& error) {
      const std::size_t read = message_count(stored) - before;
      if (notices == nullptr || read == 0) throw;
      notices->push_back(error.faults()[0].line() + "; the " + counted(read, "cloud") +
                         " before that are used");
    }
  }
  std::vector<CloudTopic> topics;
  for (const StoredTopic& topic : stored.clouds) {
    if (!topic.messages.empty()) topics.push_back(cloud_topic(topic));
  }
  if (topics.empty()) fail_without_clouds(path, stored);
  std::sort(topics.begin(), topics.end(),
            [](const CloudTopic& a, const CloudTopic& b) { return a.name < b.name; });
  return topics;
}

}  // namespace croon
