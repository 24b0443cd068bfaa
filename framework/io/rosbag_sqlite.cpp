#include <sqlite3.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "framework/base/scalar_type.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/stored_messages.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

/// The URI with which SQLite opens `path` read-only, without writing auxiliary files unless the
/// journal of an interrupted recording must be read.
std::string read_only_uri(const fs::path& path) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : fs::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = (byte < 0x80 && std::isalnum(byte) != 0) || c == '/';
    uri += is_plain ? std::string(1, c) : std::string{'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  std::error_code error;
  const auto has_bytes = [&](const char* ending) {
    const std::uintmax_t size = fs::file_size(path.string() + ending, error);
    return !error && size > 0;
  };
  return uri + (has_bytes("-wal") || has_bytes("-journal") ? "?mode=ro" : "?immutable=1");
}

/// Whether the file has fewer pages than its header declares
/// (https://www.sqlite.org/fileformat.html, 1.3).
bool is_cut(const fs::path& path) {
  std::string head(100, '\0');
  std::ifstream(path, std::ios::binary)
      .read(head.data(), static_cast<std::streamsize>(head.size()));
  const auto number = [&](std::size_t at, std::size_t size) {
    const ScalarType type{ScalarKind::unsigned_integer, size};
    return decode_scalar(type, ByteOrder::big, head.data() + at);
  };
  const double page_bytes = number(16, 2) == 1 ? 65536 : number(16, 2);
  const bool is_declared = number(24, 4) == number(92, 4);
  std::error_code error;
  const auto file_bytes = static_cast<double>(fs::file_size(path, error));
  return is_declared && !error && file_bytes < page_bytes * number(28, 4);
}

/// The file of a rosbag2, open for reading.
class RosbagDatabase {
 public:
  explicit RosbagDatabase(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    if (!fs::is_regular_file(path_, error)) {
      throw UnavailableFile(path_.string(), "",
                            "expected a readable file, found " + found_instead_of_file(path_));
    }
    sqlite3* database = nullptr;
    const int code = sqlite3_open_v2(read_only_uri(path_).c_str(), &database,
                                     SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database_.reset(database);
    if (code != SQLITE_OK) fail();
    int ignored = 0;
    sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, &ignored);
    // Without this, SQLite reads nothing of a file that is shorter than its header declares.
    sqlite3_db_config(database, SQLITE_DBCONFIG_WRITABLE_SCHEMA, 1, &ignored);
    for_each("PRAGMA cell_size_check = ON", [](sqlite3_stmt*) {});
  }

  /// Calls `use` with each row of the query.
  template <class Use>
  void for_each(const char* query, const Use& use) {
    sqlite3_stmt* prepared = nullptr;
    const int code = sqlite3_prepare_v2(database_.get(), query, -1, &prepared, nullptr);
    const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement(prepared,
                                                                          sqlite3_finalize);
    if (code != SQLITE_OK) fail();
    int step = SQLITE_ROW;
    while ((step = sqlite3_step(prepared)) == SQLITE_ROW) use(prepared);
    if (step != SQLITE_DONE) fail();
  }

  /// Reads the first `max_bytes` of the message in this row of the table.
  std::string read_message(std::int64_t row, std::size_t max_bytes) {
    if (blob_ == nullptr) {
      sqlite3_blob* blob = nullptr;
      const int code =
          sqlite3_blob_open(database_.get(), "main", "messages", "data", row, 0, &blob);
      blob_.reset(blob);
      if (code != SQLITE_OK) fail();
    } else if (sqlite3_blob_reopen(blob_.get(), row) != SQLITE_OK) {
      fail();
    }
    const auto stored = static_cast<std::size_t>(sqlite3_blob_bytes(blob_.get()));
    std::string bytes(std::min(stored, max_bytes), '\0');
    const int size = static_cast<int>(bytes.size());
    if (sqlite3_blob_read(blob_.get(), bytes.data(), size, 0) != SQLITE_OK) fail();
    return bytes;
  }

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
    void operator()(sqlite3_blob* blob) const { sqlite3_blob_close(blob); }
  };

  [[noreturn]] void fail() const {
    const std::string words = sqlite3_errmsg(database_.get());
    switch (sqlite3_errcode(database_.get())) {
      case SQLITE_NOTADB:
        throw InputError(path_.string(), "", "is not an SQLite file, unlike a rosbag2 (.db3)");
      case SQLITE_CANTOPEN:
      case SQLITE_BUSY:
      case SQLITE_IOERR:
        throw UnavailableFile(path_.string(), "", "cannot be read: " + words);
      default:
        throw DamagedRecording(path_.string(), "",
                               "the recording is damaged or incomplete: " + words);
    }
  }

  fs::path path_;
  std::unique_ptr<sqlite3, Close> database_;
  std::unique_ptr<sqlite3_blob, Close> blob_;
};

std::string text_of(sqlite3_stmt* row, int column) {
  const unsigned char* const text = sqlite3_column_text(row, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(row, column));
  return text == nullptr ? "" : std::string(reinterpret_cast<const char*>(text), size);
}

/// Throws InputError unless the tables of a rosbag2 exist.
void check_tables(RosbagDatabase& database, const fs::path& file) {
  int tables = 0;
  // Views and virtual tables, which do not occur in recordings, have no root page.
  database.for_each(
      "SELECT 1 FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name IN ('topics', "
      "'messages')",
      [&](sqlite3_stmt*) { ++tables; });
  if (tables == 2) return;
  throw InputError(file.string(), "",
                   "expected the tables topics and messages of a rosbag2, found another SQLite "
                   "file");
}

}  // namespace

void read_rosbag_sqlite(const fs::path& file, StoredTopics& topics) {
  RosbagDatabase database(file);
  check_tables(database, file);
  std::map<std::int64_t, std::string> names;
  database.for_each("SELECT id, name, type, serialization_format FROM topics",
                    [&](sqlite3_stmt* row) {
                      const std::string type = text_of(row, 2), format = text_of(row, 3);
                      if (!is_cloud_type(type)) {
                        topics.other_types.insert(type);
                        return;
                      }
                      const std::string name = text_of(row, 1);
                      if (format != "cdr") {
                        throw InputError(file.string(), name,
                                         "expected messages in cdr, found " + in_quotes(format));
                      }
                      names[sqlite3_column_int64(row, 0)] = name;
                    });
  // In a truncated file, the ends of the last messages are missing.
  const bool has_cut = is_cut(file);
  const std::size_t checked_bytes =
      has_cut ? std::numeric_limits<std::size_t>::max() : kMessageHeadBytes;
  database.for_each("SELECT rowid, topic_id, timestamp FROM messages", [&](sqlite3_stmt* row) {
    const auto name = names.find(sqlite3_column_int64(row, 1));
    if (name == names.end()) return;
    const std::int64_t id = sqlite3_column_int64(row, 0);
    StoredMessage message;
    message.log_time_s = static_cast<double>(sqlite3_column_int64(row, 2)) * 1e-9;
    // Not with substr(), for which SQLite would read the whole message.
    message.head = database.read_message(id, checked_bytes).substr(0, kMessageHeadBytes);
    message.read = [file, id] {
      return RosbagDatabase(file).read_message(id, std::numeric_limits<std::size_t>::max());
    };
    message.file = file;
    topics.cloud_topic(name->second).messages.push_back(std::move(message));
  });
  if (has_cut) {
    throw DamagedRecording(
        file.string(), "",
        "the recording is damaged or incomplete: it is shorter than its header declares");
  }
}

}  // namespace croon
