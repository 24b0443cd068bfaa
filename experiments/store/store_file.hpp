#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/store/database.hpp"

namespace croon::experiments {

// The file of a store: how it is recognised, created, opened and replaced.
//
// A rollback journal never exists beside a store, because readers could not open a store with the
// journal of a killed process, which only a writer can roll back. So a store is built under another
// name, without a journal on disk, and renamed; it is written only with a write-ahead log, which
// readers understand; and its journal mode never changes. Earlier versions changed it, so the
// journals that they left are rolled back.

/// Identifies SQLite files of croon ("croo").
inline constexpr std::uint32_t kApplicationId = 0x63726F6F;

/// The file of the store of a folder of results.
std::filesystem::path store_path(const std::filesystem::path& folder);

/// The files of a store: its own, and those beside it while it is open or being built.
std::vector<std::filesystem::path> store_files(const std::filesystem::path& path);

/// Whether `path` may have been left by a process killed while it wrote a store: an empty file, a
/// store, or a journal or log of SQLite.
bool is_left_by_sqlite(const std::filesystem::path& path);

/// Whether there is a store at `path`; an empty file is not a store. Rolls back incomplete changes
/// of an earlier version. Throws InputError if there is anything else (a folder, a pipe, a file or
/// a database of another program), and does not change it.
bool has_store(const std::filesystem::path& path);

/// Opens the store `path` for reading and checks its schema. Rolls back incomplete changes of an
/// earlier version. Throws InputError if there is no store.
Database open_to_read(const std::filesystem::path& path);

/// Opens the store `path` exclusively for this process, and creates it if there is none.
Database open_to_write(const std::filesystem::path& path);

/// Creates a new store at `path`, replacing any existing one. `fill` receives the new store with
/// empty tables and may read the old one. If it throws, the old store stays.
void build_store(const std::filesystem::path& path, const std::function<void(Database&)>& fill);

/// Replaces the store `path`, if any, by the store `by`, which must not be open. One of them exists
/// at every moment.
void replace_store(const std::filesystem::path& path, const std::filesystem::path& by);

}  // namespace croon::experiments
