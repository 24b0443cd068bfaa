#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/store/database.hpp"

namespace croon::experiments {

// The file of a store: whether it is one, and how it comes into being, is opened and replaced.
//
// A rollback journal never arises beside a store. A reader could not open a store with the journal
// of a killed process, which only a writer rolls back. So a store is built under another name,
// without a journal on disk, and renamed; it is written to with a write-ahead log only, which
// readers understand; and its journal mode never changes. Earlier versions changed it, so the
// journals that they left are rolled back.

/// The file of the store of a folder of results.
std::filesystem::path store_path(const std::filesystem::path& folder);

/// The files of a store: its own, and those that are beside it while it is open or built.
std::vector<std::filesystem::path> store_files(const std::filesystem::path& path);

/// Whether `path` is a file that a process leaves when it is killed while it writes a store: empty,
/// a store, or a journal or log of SQLite.
bool is_left_by_sqlite(const std::filesystem::path& path);

/// Whether there is a store at `path`; an empty file is none. Rolls back what an earlier version
/// left half-done. Throws InputError if there is anything else, and does not change it: a folder, a
/// pipe, a file or a database of another program.
bool has_store(const std::filesystem::path& path);

/// Opens the store `path` to read it and checks its schema. Rolls back what an earlier version left
/// half-done. Throws InputError if there is no store.
Database open_to_read(const std::filesystem::path& path);

/// Opens the store `path` for this process alone, and creates it if there is none.
Database open_to_write(const std::filesystem::path& path);

/// Puts a new store in the place of `path`, whether there is one or not. `fill` gets the new one
/// with empty tables and may read the old one. If it throws, the old one stays.
void build_store(const std::filesystem::path& path, const std::function<void(Database&)>& fill);

/// Replaces the store `path`, if there is one, by the store `by`, which no one may have open. One
/// of them exists at every moment.
void replace_store(const std::filesystem::path& path, const std::filesystem::path& by);

}  // namespace croon::experiments
