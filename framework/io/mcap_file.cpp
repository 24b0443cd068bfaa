#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "framework/base/memory.hpp"
#include "framework/base/scalar_type.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/decompress.hpp"
#include "framework/io/stored_messages.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);
constexpr std::uint64_t kRecordHeadBytes = 9;    ///< The kind of a record and its length.
constexpr std::uint64_t kMcapMessageBytes = 22;  ///< A message without its data.

/// The kinds of records that are used, see mcap.dev/spec.
enum Kind : std::uint8_t {
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  data_end = 15
};

[[noreturn]] void fail_damaged(const Fault& place, const std::string& message) {
  throw DamagedRecording(place.file, place.where, message);
}

std::string byte_place(std::uint64_t offset) { return "byte " + std::to_string(offset); }

/// The bytes of a file or of a decompressed chunk.
class ByteSource {
 public:
  explicit ByteSource(const fs::path& file) : stream_(file, std::ios::binary) {
    std::error_code error;
    size_ = fs::file_size(file, error);
    if (error || !stream_) {
      throw UnavailableFile(file.string(), "",
                            "expected a readable file, found " + found_instead_of_file(file));
    }
  }
  explicit ByteSource(std::string bytes) : bytes_(std::move(bytes)), size_(bytes_.size()) {}

  std::uint64_t size() const { return size_; }

  /// Reads up to `count` bytes at `offset`, fewer at the end.
  std::string read(std::uint64_t offset, std::uint64_t count) {
    count = offset < size_ ? std::min(count, size_ - offset) : 0;
    if (!stream_.is_open()) return bytes_.substr(std::min(offset, size_), count);
    std::string bytes(count, '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(stream_.gcount()));
    return bytes;
  }

 private:
  std::ifstream stream_;
  std::string bytes_;
  std::uint64_t size_ = 0;
};

/// Reads the fields of a record: little-endian numbers, and texts after their lengths.
class McapRecordReader {
 public:
  McapRecordReader(std::string_view content, Fault place)
      : content_(content), place_(std::move(place)) {}

  std::string_view bytes(std::uint64_t count) {
    if (count > content_.size()) {
      fail_damaged(place_, "the record is damaged: expected " + std::to_string(count) +
                               " bytes, found " + std::to_string(content_.size()));
    }
    const std::string_view taken = content_.substr(0, count);
    content_.remove_prefix(count);
    return taken;
  }
  std::uint64_t number(std::size_t size) {
    const std::string_view digits = bytes(size);
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) {
      value = value * 256 + static_cast<unsigned char>(digits[i]);
    }
    return value;
  }
  std::string text() { return std::string(bytes(number(4))); }
  std::string_view left() const { return content_; }

 private:
  std::string_view content_;
  Fault place_;
};

/// A chunk: the position of its records in the file, and their compression.
struct Chunk {
  fs::path file;
  std::uint64_t offset = 0;
  std::uint64_t stored_bytes = 0;
  std::uint64_t bytes = 0;
  std::uint32_t crc = 0;  ///< Of the decompressed bytes; 0 if it was not computed.
  std::string compression;
};

std::string expand(const Chunk& chunk, ByteSource& file) {
  const Fault place{chunk.file.string(), "chunk at " + byte_place(chunk.offset), "", {}};
  require_memory(static_cast<double>(chunk.stored_bytes), "to read a chunk of this recording",
                 "write it with smaller chunks", place);
  std::string bytes = file.read(chunk.offset, chunk.stored_bytes);
  if (chunk.compression == "lz4") bytes = decompress_lz4(bytes, chunk.bytes, place);
  if (chunk.compression == "zstd") bytes = decompress_zstd(bytes, chunk.bytes, place);
  if (bytes.size() != chunk.bytes) {
    fail_damaged(place, "the chunk is damaged: expected " + std::to_string(chunk.bytes) +
                            " bytes, found " + std::to_string(bytes.size()));
  }
  const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  if (chunk.crc != 0 && chunk.crc != crc) {
    fail_damaged(place, "the chunk is damaged: its checksum is wrong");
  }
  return bytes;
}

/// Visits the records of a file and of its chunks.
class McapReader {
 public:
  McapReader(fs::path path, StoredTopics& topics)
      : path_(std::move(path)), file_(path_), topics_(topics) {}

  void read() {
    if (file_.read(0, kMcapMagic.size()) != kMcapMagic) fail("", "is not an MCAP file");
    const bool is_complete = read_records(file_, kMcapMagic.size(), file_.size(), nullptr);
    if (is_complete) return;
    fail_damaged({path_.string(), byte_place(file_.size()), "", {}},
                 "ends without the end of an MCAP file: the recording was interrupted, or the file "
                 "is incomplete (" +
                     in_quotes("mcap recover") + " repairs such files)");
  }

 private:
  [[noreturn]] void fail(const std::string& where, const std::string& message) const {
    throw InputError(path_.string(), where, message);
  }

  /// Reads the records from `begin` to `end`, in `chunk` unless it is null. Returns whether the
  /// last record of the data was found.
  bool read_records(ByteSource& source, std::uint64_t begin, std::uint64_t end,
                    const std::shared_ptr<const Chunk>& chunk) {
    for (std::uint64_t at = begin; at < end;) {
      const std::string head = source.read(at, kRecordHeadBytes + kMcapMessageBytes);
      const Fault place{
          path_.string(),
          chunk ? "chunk at " + byte_place(chunk->offset) + ", " + byte_place(at) : byte_place(at),
          "",
          {}};
      if (end - at < kRecordHeadBytes) return false;
      McapRecordReader reader(head, place);
      const auto kind = static_cast<std::uint8_t>(reader.number(1));
      const std::uint64_t length = reader.number(8);
      if (kind == Kind::footer || kind == Kind::data_end) return true;
      if (kind == 0) fail_damaged(place, "the recording is damaged: expected a record, found 0");
      at += kRecordHeadBytes;
      if (length > end - at) {
        if (chunk == nullptr) return false;
        fail_damaged(place, "the chunk is damaged: a record extends beyond it");
      }
      read_record(source, kind, at, length, chunk, place);
      at += length;
    }
    return false;
  }

  void read_record(ByteSource& source, std::uint8_t kind, std::uint64_t offset,
                   std::uint64_t length, const std::shared_ptr<const Chunk>& chunk,
                   const Fault& place) {
    constexpr std::uint64_t kMaxTextBytes = 16 << 20;
    if (kind == Kind::message) return add_message(source, offset, length, chunk, place);
    if (kind == Kind::chunk && chunk == nullptr) return read_chunk(offset, length, place);
    if (kind != Kind::schema && kind != Kind::channel) return;
    if (length > kMaxTextBytes) fail_damaged(place, "a text record is implausibly large");
    const std::string content = source.read(offset, length);
    McapRecordReader reader(content, place);
    const auto id = static_cast<std::uint16_t>(reader.number(2));
    if (kind == Kind::schema) {
      const std::string name = reader.text();
      schemas_[id] = {name, reader.text()};
    } else {
      add_channel(id, reader);
    }
  }

  struct Schema {
    std::string name, encoding;
  };

  void add_channel(std::uint16_t id, McapRecordReader& reader) {
    const auto schema_id = static_cast<std::uint16_t>(reader.number(2));
    const std::string topic = reader.text();
    const std::string encoding = reader.text();
    const auto at = schemas_.find(schema_id);
    const Schema schema = at == schemas_.end() ? Schema{} : at->second;
    if (!is_cloud_type(schema.name)) {
      topics_.other_types.insert(schema.name.empty() ? "messages without a type" : schema.name);
      return;
    }
    if (encoding == "ros1" || schema.encoding == "ros1msg") {
      fail(topic, "expected messages of ROS 2, found messages of ROS 1; convert the bag with " +
                      in_quotes("rosbags-convert --src drive.bag --dst drive") +
                      " and pass the folder");
    }
    if (encoding != "cdr") fail(topic, "expected messages in cdr, found " + in_quotes(encoding));
    channels_[id] = topic;
  }

  void read_chunk(std::uint64_t offset, std::uint64_t length, const Fault& place) {
    // The times, the size, the checksum, the name of the compression, and the compressed size.
    constexpr std::uint64_t kMaxChunkHeadBytes = 256;
    const std::string head = file_.read(offset, std::min(length, kMaxChunkHeadBytes));
    McapRecordReader reader(head, place);
    reader.bytes(16);
    Chunk chunk{path_, 0, 0, 0, 0, ""};
    chunk.bytes = reader.number(8);
    chunk.crc = static_cast<std::uint32_t>(reader.number(4));
    chunk.compression = reader.text();
    chunk.stored_bytes = reader.number(8);
    const std::uint64_t head_bytes = head.size() - reader.left().size();
    chunk.offset = offset + head_bytes;
    if (chunk.stored_bytes > length - head_bytes) {
      fail_damaged(place, "the chunk is damaged: its records extend beyond it");
    }
    if (chunk.compression.empty()) {
      // Visited in the file, so that only the head of each message is read.
      read_records(file_, chunk.offset, chunk.offset + chunk.stored_bytes,
                   std::make_shared<Chunk>(chunk));
      return;
    }
    if (chunk.compression != "lz4" && chunk.compression != "zstd") {
      fail(place.where, "expected chunks without compression or with lz4 or zstd, found " +
                            in_quotes(chunk.compression));
    }
    ByteSource records(expand(chunk, file_));
    read_records(records, 0, records.size(), std::make_shared<Chunk>(std::move(chunk)));
  }

  void add_message(ByteSource& source, std::uint64_t offset, std::uint64_t length,
                   const std::shared_ptr<const Chunk>& chunk, const Fault& place) {
    const std::string head =
        source.read(offset, std::min<std::uint64_t>(length, kMcapMessageBytes + kMessageHeadBytes));
    McapRecordReader reader(head, place);
    const auto topic = channels_.find(static_cast<std::uint16_t>(reader.number(2)));
    reader.bytes(4);  // Sequence number.
    const double log_time_s = static_cast<double>(reader.number(8)) * 1e-9;
    reader.bytes(8);  // Publish time.
    if (topic == channels_.end()) return;
    const std::uint64_t begin = offset + kMcapMessageBytes;
    const std::uint64_t bytes = length - kMcapMessageBytes;
    const bool is_expanded = chunk != nullptr && !chunk->compression.empty();
    const auto load = [path = path_, chunk, begin, bytes, is_expanded] {
      ByteSource file(path);
      if (is_expanded) return expand(*chunk, file).substr(begin, bytes);
      std::string message = file.read(begin, bytes);
      if (message.size() < bytes) {
        throw UnavailableFile(path.string(), byte_place(begin), "the file has become shorter");
      }
      return message;
    };
    topics_.cloud_topic(topic->second)
        .messages.push_back({log_time_s, std::string(reader.left()), load, path_});
  }

  fs::path path_;
  ByteSource file_;
  StoredTopics& topics_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, std::string> channels_;  ///< The topics with clouds.
};

}  // namespace

void read_mcap(const fs::path& file, StoredTopics& topics) { McapReader(file, topics).read(); }

}  // namespace croon
