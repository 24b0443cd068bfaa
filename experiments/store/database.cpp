#include "experiments/store/database.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <stdexcept>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(sqlite3* database, const std::string& file) {
  const int code = database == nullptr ? SQLITE_NOMEM : sqlite3_errcode(database);
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) {
    throw InputError(file, "", "another croon is working on this store");
  }
  if (code == SQLITE_ERROR || code == SQLITE_MISUSE || code == SQLITE_CONSTRAINT) {
    throw std::logic_error(file + ": " + sqlite3_errmsg(database));
  }
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
    throw UnreadableDatabase(file, "", std::string("is damaged: ") + sqlite3_errmsg(database));
  }
  std::error_code error;
  if ((code == SQLITE_CANTOPEN || code == SQLITE_READONLY) && fs::exists(file + "-wal", error)) {
    throw InputError(file, "",
                     "was left by an interrupted run, and its folder is not writable, "
                     "which is necessary for the first reading; copy the folder to a writable "
                     "place and read the copy");
  }
  const char* reason = database == nullptr ? "out of memory" : sqlite3_errmsg(database);
  throw InputError(file, "", std::string("expected a readable and writable store: ") + reason);
}

/// The maximum size of a text or blob in a store, in bytes: more than the manifest of ten thousand
/// variants.
constexpr int kMaxValueBytes = 1 << 28;

/// The URI with which SQLite opens `path` with `option`.
std::string uri_of(const fs::path& path, const std::string& option) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : fs::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = (byte < 0x80 && std::isalnum(byte) != 0) || c == '/';
    uri += is_plain ? std::string(1, c) : std::string{'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return uri + "?" + option;
}

int open_flags(Access access) {
  switch (access) {
    case Access::read:
    case Access::snapshot:
      return SQLITE_OPEN_READONLY;
    case Access::write:
      return SQLITE_OPEN_READWRITE;
    case Access::memory:
    case Access::create:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  }
  throw std::logic_error("invalid access");
}

/// Whether the rollback journal `path` ends with the name of a super-journal
/// (https://www.sqlite.org/fileformat.html, 3). Only transactions over several files have one, and
/// croon never writes any. SQLite deletes the file of that name when it rolls back the journal.
bool names_super_journal(const fs::path& path) {
  constexpr std::array<unsigned char, 8> kMagic = {0xD9, 0xD5, 0x05, 0xF9, 0x20, 0xA1, 0x63, 0xD7};
  std::ifstream stream(path, std::ios::binary);
  std::array<char, kMagic.size()> end{};
  stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  if (!stream.read(end.data(), end.size())) return false;
  return std::equal(end.begin(), end.end(), kMagic.begin(),
                    [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

/// Throws InputError if a file beside the database `path` is unsafe for SQLite to open.
void refuse_unsafe_siblings(const fs::path& path) {
  std::error_code error;
  // SQLite follows a link and looks beside the file that the link points to.
  const bool is_link = fs::is_symlink(fs::symlink_status(path, error));
  const fs::path file = is_link ? fs::canonical(path, error) : path;
  for (const char* ending : {"-journal", "-wal", "-shm"}) {
    const fs::path sibling = file.string() + ending;
    const fs::file_status status = fs::symlink_status(sibling, error);
    if (status.type() == fs::file_type::not_found || fs::is_regular_file(status)) continue;
    throw InputError(sibling.string(), "",
                     "expected a file of a store, found " + found_instead_of_file(sibling));
  }
  const fs::path journal = file.string() + "-journal";
  if (!names_super_journal(journal)) return;
  throw InputError(journal.string(), "",
                   "expected the journal of a store, found one that names another file for SQLite "
                   "to delete; croon writes no such journal");
}

/// Enables SQLite's defences against malicious files.
void defend(sqlite3* database) {
  int ignored = 0;
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, &ignored);
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, &ignored);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, &ignored);
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kMaxValueBytes);
}

}  // namespace

Statement::Statement(sqlite3* database, const std::string& file, const std::string& sql)
    : database_(database), file_(file) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr);
  statement_.reset(statement);
  check(code);
}

void Statement::Finalise::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

void Statement::check(int code) {
  if (code != SQLITE_OK) fail(database_, file_);
}

void Statement::bind(int parameter, const std::string& text) {
  check(sqlite3_bind_text(statement_.get(), parameter + 1, text.data(),
                          static_cast<int>(text.size()), SQLITE_TRANSIENT));
}

void Statement::bind(int parameter, std::int64_t number) {
  check(sqlite3_bind_int64(statement_.get(), parameter + 1, number));
}

void Statement::bind(int parameter, double number) {
  check(sqlite3_bind_double(statement_.get(), parameter + 1, number));
}

void Statement::bind_bytes(int parameter, const std::string& bytes) {
  check(sqlite3_bind_blob(statement_.get(), parameter + 1, bytes.data(),
                          static_cast<int>(bytes.size()), SQLITE_TRANSIENT));
}

bool Statement::next() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) fail(database_, file_);
  return false;
}

void Statement::reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::string Statement::text(int column) const {
  const unsigned char* text = sqlite3_column_text(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return text == nullptr ? "" : std::string(reinterpret_cast<const char*>(text), size);
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double Statement::real(int column) const { return sqlite3_column_double(statement_.get(), column); }

Database::Database(const std::filesystem::path& path, Access access) : file_(path.string()) {
  const bool is_alone = access == Access::memory || access == Access::snapshot;
  if (!is_alone) refuse_unsafe_siblings(path);
  sqlite3* database = nullptr;
  std::string name = ":memory:";
  if (access != Access::memory)
    name = uri_of(path, access == Access::snapshot ? "immutable=1" : "");
  const int flags = open_flags(access) | SQLITE_OPEN_URI;
  const int code = sqlite3_open_v2(name.c_str(), &database, flags, nullptr);
  database_.reset(database);
  if (code != SQLITE_OK) fail(database, file_);
  defend(database);
  run("PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0");
}

void Database::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

void Database::run(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
    fail(database_.get(), file_);
  }
}

Statement Database::prepare(const std::string& sql) const {
  return Statement(database_.get(), file_, sql);
}

Transaction::~Transaction() {
  // An error may already have rolled it back.
  if (is_open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_.run("COMMIT");
  is_open_ = false;
}

Attachment::Attachment(Database& database, const std::filesystem::path& path,
                       const std::string& name)
    : database_(database), name_(name) {
  refuse_unsafe_siblings(path);
  Statement attach = database.prepare("ATTACH ? AS " + name);
  attach.bind(0, uri_of(path, "mode=ro"));
  attach.next();
}

Attachment::~Attachment() {
  sqlite3_exec(database_.handle(), ("DETACH " + name_).c_str(), nullptr, nullptr, nullptr);
}

}  // namespace croon::experiments
