#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "framework/base/error.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace croon::experiments {

/// A prepared SQL statement. Parameters and columns count from 0.
class Statement {
 public:
  Statement(sqlite3* database, const std::string& file, const std::string& sql);

  void bind(int parameter, const std::string& text);
  void bind(int parameter, std::int64_t number);
  void bind(int parameter, double number);
  void bind_bytes(int parameter, const std::string& bytes);

  /// Advances to the next row; returns false after the last one.
  bool next();
  /// Resets the statement for another run; parameters become null.
  void reset();

  bool is_null(int column) const;
  std::string text(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;

 private:
  struct Finalise {
    void operator()(sqlite3_stmt* statement) const;
  };
  void check(int code);

  sqlite3* database_;
  std::string file_;
  std::unique_ptr<sqlite3_stmt, Finalise> statement_;
};

/// The file is not an SQLite database, or is damaged.
class UnreadableDatabase : public InputError {
  using InputError::InputError;
};

/// How a Database opens its file.
enum class Access {
  read,      ///< Reads the file and SQLite's files beside it.
  snapshot,  ///< Reads only the bytes of the file; creates and locks nothing.
  memory,    ///< No file: an empty database in memory.
  write,     ///< Modifies an existing file.
  create     ///< Modifies the file; creates it if missing.
};

/// An SQLite file. If SQLite fails (no space, no permission, not a database, in use by another
/// process), functions throw InputError with the name of the file.
class Database {
 public:
  /// Opens `path`. The file is not trusted: functions named in its schema have no side effects, its
  /// triggers do not run, and values are limited in size. Throws InputError if one of SQLite's
  /// files beside it (-journal, -wal, -shm) is not a regular file, or is a journal that would make
  /// SQLite delete another file.
  Database(const std::filesystem::path& path, Access access);

  /// Runs statements that return no rows.
  void run(const std::string& sql);
  const std::string& file() const { return file_; }
  sqlite3* handle() const { return database_.get(); }
  Statement prepare(const std::string& sql) const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::string file_;
  std::unique_ptr<sqlite3, Close> database_;
};

/// A transaction; rolled back unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) {
    database_.run("BEGIN IMMEDIATE");
  }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool is_open_ = true;
};

/// Attaches another SQLite file to a database under a name, for reading, during the lifetime of
/// this object.
class Attachment {
 public:
  Attachment(Database& database, const std::filesystem::path& path, const std::string& name);
  ~Attachment();
  Attachment(const Attachment&) = delete;
  Attachment& operator=(const Attachment&) = delete;

 private:
  Database& database_;
  std::string name_;
};

}  // namespace croon::experiments
