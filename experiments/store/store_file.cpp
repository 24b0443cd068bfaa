#include "experiments/store/store_file.hpp"

#include <array>
#include <fstream>
#include <string_view>

#include "experiments/store/store_check.hpp"
#include "experiments/store/store_schema.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// The positions in the header of an SQLite file of the identifier of its program, and of the
/// version that indicates a write-ahead log (https://www.sqlite.org/fileformat.html, 1.3).
constexpr std::size_t kApplicationIdOffset = 68;
constexpr std::size_t kWriteVersionOffset = 18;
constexpr char kVersionWithLog = 2;

using FileHeader = std::array<char, 100>;

fs::path beside(const fs::path& path, const char* ending) { return path.string() + ending; }

/// The first bytes of the file `path`, padded with zeros.
FileHeader header_bytes(const fs::path& path) {
  FileHeader bytes{};
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw InputError(path.string(), "", "expected a readable store, found an unreadable one");
  stream.read(bytes.data(), bytes.size());
  return bytes;
}

std::uint32_t application_id(const FileHeader& bytes) {
  std::uint32_t id = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    id = (id << 8) | static_cast<unsigned char>(bytes[kApplicationIdOffset + i]);
  }
  return id;
}

bool is_sqlite_file(const FileHeader& bytes) {
  constexpr std::string_view kMagic("SQLite format 3\0", 16);
  return std::string_view(bytes.data(), kMagic.size()) == kMagic;
}

[[noreturn]] void refuse_other_file(const fs::path& path, const std::string& found) {
  throw InputError(path.string(), "", "expected the store of a run, found " + found);
}

/// Describes the file at `path`, which is not a store, for a message.
std::string found_instead_of_store(const fs::path& path) {
  if (!fs::is_regular_file(path)) return "none";
  if (fs::is_empty(path)) return "an empty file";
  return "a database without the tables of a store; those of a killed run are in " + path.string() +
         "-wal beside it";
}

void refuse_unless_file(const fs::path& path) {
  std::error_code error;
  // Checked before opening: opening a pipe would wait for a writer.
  if (!fs::is_regular_file(path, error)) refuse_other_file(path, found_instead_of_file(path));
}

bool has_bytes(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && fs::file_size(path, error) > 0 && !error;
}

void remove_files(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    std::error_code error;
    fs::remove(file, error);
    if (error) throw InputError(file.string(), "", "cannot be deleted: " + error.message());
  }
}

/// Throws InputError if the database `path`, of which only its own pages are read, belongs to
/// another program. Returns whether it has the tables of a store and enough of their columns to
/// exclude a coincidence.
bool has_store_tables(const fs::path& path, Access access) {
  const Database database(path, access);
  Statement tables = database.prepare("SELECT count(*) FROM sqlite_master WHERE type = 'table'");
  if (!tables.next() || tables.integer(0) == 0) return false;
  Statement columns = database.prepare(
      "SELECT count(*) FROM sqlite_master AS of, pragma_table_info(of.name) AS has "
      "WHERE of.type = 'table' AND (of.name || '.' || has.name) IN "
      "('meta.name', 'meta.value', 'trials.variant', 'trials.scene', 'trials.sensor', "
      "'trials.trial', 'trials.status')");
  constexpr int kAllOfThem = 7;
  if (!columns.next() || columns.integer(0) != kAllOfThem) {
    refuse_other_file(path, "the database of another program");
  }
  return true;
}

/// Whether a process of an earlier version was killed while it changed the journal mode of `path`.
/// Throws InputError if the file is a database of another program.
bool has_old_journal(const fs::path& path) {
  if (!has_bytes(beside(path, "-journal"))) return false;
  try {
    if (application_id(header_bytes(path)) != kApplicationId) {
      has_store_tables(path, Access::snapshot);
    }
  } catch (const UnreadableDatabase&) {
    // A page is half-written; the journal repairs it.
  }
  return true;
}

/// Moves the content of the log of the store `path` into its file.
void empty_log(const fs::path& path) {
  const Database database(path, Access::write);
  Statement checkpoint = database.prepare("PRAGMA wal_checkpoint(TRUNCATE)");
  if (!checkpoint.next() || checkpoint.integer(0) != 0) {
    throw InputError(path.string(), "", "another croon is working on this store");
  }
}

/// Calls `write`, which creates a file beside the store `path`, and renames that file to `path`.
void replace_by(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  const fs::path working = beside(path, ".new");
  const std::vector<fs::path> files = store_files(working);
  remove_files(files);
  try {
    write(working);
    replace_store(path, working);
  } catch (...) {
    std::error_code ignored;
    for (const fs::path& file : files) fs::remove(file, ignored);
    throw;
  }
}

void copy_to(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, error);
  if (error) throw InputError(to.string(), "", "cannot be written: " + error.message());
}

/// Switches to a write-ahead log without a journal on disk: if the process is killed, the
/// incomplete file is discarded.
void begin_log(Database& database) {
  database.run("PRAGMA journal_mode = MEMORY; PRAGMA journal_mode = WAL;");
}

/// Makes `path` a store with a write-ahead log.
void provide_log(const fs::path& path) {
  if (!has_store(path)) return build_store(path, begin_log);
  if (header_bytes(path)[kWriteVersionOffset] == kVersionWithLog) return;
  empty_log(path);
  replace_by(path, [&](const fs::path& working) {
    copy_to(path, working);
    Database database(working, Access::write);
    begin_log(database);
  });
}

}  // namespace

bool is_left_by_sqlite(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(path, error))) return false;
  if (fs::file_size(path, error) == 0) return true;
  const FileHeader bytes = header_bytes(path);
  if (is_sqlite_file(bytes)) return application_id(bytes) == kApplicationId;
  // A rollback journal, a write-ahead log and its index
  // (https://www.sqlite.org/fileformat.html, 3 and 4; https://www.sqlite.org/walformat.html, 2.1).
  // A journal that is no longer needed begins with zeros.
  const std::string_view first(bytes.data(), 4);
  using namespace std::string_view_literals;
  return first == "\xD9\xD5\x05\xF9"sv || first == "\x37\x7F\x06\x82"sv ||
         first == "\x37\x7F\x06\x83"sv || first == "\x18\xE2\x2D\x00"sv ||
         first == "\x00\x00\x00\x00"sv;
}

fs::path store_path(const fs::path& folder) { return folder / "store.sqlite"; }

std::vector<fs::path> store_files(const fs::path& path) {
  std::vector<fs::path> files;
  for (const std::string base : {"", ".new"}) {
    for (const char* ending : {"", "-journal", "-wal", "-shm"}) {
      files.push_back(path.string() + base + ending);
    }
  }
  return files;
}

bool has_store(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return false;
  refuse_unless_file(path);
  if (has_old_journal(path)) {
    const Database database(path, Access::write);
    database.prepare("SELECT count(*) FROM sqlite_master").next();
  }
  if (!has_bytes(path)) return false;
  const FileHeader bytes = header_bytes(path);
  if (!is_sqlite_file(bytes)) refuse_other_file(path, "a file that is not a database");
  const std::uint32_t id = application_id(bytes);
  if (id == kApplicationId) return true;
  if (id != 0) refuse_other_file(path, "the database of another program");
  // A store of an earlier version. Its whole content may still be in its log.
  return has_store_tables(path, Access::snapshot) || has_store_tables(path, Access::read);
}

Database open_to_read(const fs::path& path) {
  if (!has_store(path)) refuse_other_file(path, found_instead_of_store(path));
  Database database(path, Access::read);
  check_schema(database, store_schema());
  return database;
}

Database open_to_write(const fs::path& path) {
  provide_log(path);
  Database database(path, Access::write);
  database.run(
      "PRAGMA main.locking_mode = EXCLUSIVE; PRAGMA synchronous = FULL; BEGIN EXCLUSIVE; COMMIT;");
  return database;
}

void build_store(const fs::path& path, const std::function<void(Database&)>& fill) {
  replace_by(path, [&](const fs::path& working) {
    // SQLite would create it with permissions that differ from those of the umask.
    write_whole_file(working, "");
    Database database(working, Access::create);
    database.run(
        "PRAGMA journal_mode = MEMORY; PRAGMA synchronous = FULL; PRAGMA application_id = " +
        std::to_string(kApplicationId) + ";BEGIN;" + store_schema() + "COMMIT;");
    fill(database);
  });
}

void replace_store(const fs::path& path, const fs::path& by) {
  if (has_store(path)) empty_log(path);
  // Otherwise SQLite would use the log of the old store for the new one.
  for (const char* ending : {"-journal", "-wal", "-shm"}) remove_files({beside(path, ending)});
  std::error_code error;
  fs::rename(by, path, error);
  if (error) throw InputError(path.string(), "", "cannot be replaced: " + error.message());
}

}  // namespace croon::experiments
