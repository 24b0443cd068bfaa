#include "experiments/session/result_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/report/result_list.hpp"
#include "experiments/report/result_tables.hpp"
#include "experiments/store/bounded_json.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

using Bytes = std::optional<std::string>;

constexpr const char* kManifest = "manifest.json";
constexpr const char* kTimings = "timings.csv";

/// The files of the databases: of the wall times, of the store, and of the store left by a merge
/// that was killed.
std::vector<fs::path> database_paths_in(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const fs::path& path :
       {timings_path(folder), store_path(folder), merged_store_path(folder)}) {
    const std::vector<fs::path> files = store_files(path);
    paths.insert(paths.end(), files.begin(), files.end());
  }
  return paths;
}

/// The paths of the databases and of all other files in a folder of results.
std::vector<fs::path> paths_in(const fs::path& folder) {
  std::vector<fs::path> paths = database_paths_in(folder);
  for (const ResultFile& file : result_files()) paths.push_back(folder / file.name);
  for (const char* name : {kManifest, kTimings, kPicture, kReport}) paths.push_back(folder / name);
  return paths;
}

/// Whether `path` is a manifest written by croon.
bool is_manifest(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  const nlohmann::json manifest = parsed_or_discarded(read_whole_file(path));
  return manifest.is_object() && manifest.contains("croon") && manifest.contains("experiment");
}

/// Whether an earlier run or merge wrote to the folder. Throws InputError if its store file is
/// something else.
bool has_results(const fs::path& folder) {
  const bool has_manifest = is_manifest(folder / kManifest);
  try {
    return has_store(store_path(folder)) || has_manifest;
  } catch (const UnreadableDatabase&) {
    // --fresh replaces a damaged store, but only if a manifest shows that it is one.
    if (!has_manifest) throw;
    return true;
  }
}

/// Throws InputError if a file that a run modifies in place has another hard link: the other file,
/// perhaps a backup, would change too.
void refuse_hard_links(const fs::path& folder) {
  std::error_code error;
  for (const fs::path& path : database_paths_in(folder)) {
    const std::uintmax_t names = fs::hard_link_count(path, error);
    if (error || names <= 1) continue;
    throw InputError(
        path.string(), "",
        "expected a file with one name, found a hard link: the other file would change "
        "too; copy the folder without links, or choose another folder with --out");
  }
}

/// Throws InputError if a run would write through a link or over a file that is not from croon.
void refuse_files_of_others(const fs::path& folder) {
  std::vector<fs::path> paths = paths_in(folder);
  paths.push_back(folder / kClouds);
  std::error_code error;
  for (const fs::path& path : paths) {
    if (!fs::is_symlink(fs::symlink_status(path, error))) continue;
    throw InputError(path.string(), "", "expected a file or nothing, found a symbolic link");
  }
  refuse_hard_links(folder);
  if (has_results(folder)) {
    if (fs::exists(folder / kManifest, error) && !is_manifest(folder / kManifest)) {
      throw InputError((folder / kManifest).string(), "",
                       "is damaged or not a manifest of croon; delete it, or restore it");
    }
    return;
  }
  const std::vector<fs::path> databases = database_paths_in(folder);
  for (const fs::path& path : paths) {
    if (!fs::exists(path, error)) continue;
    // A run killed before it created a store leaves no manifest.
    const bool is_database = std::find(databases.begin(), databases.end(), path) != databases.end();
    if (is_database && is_left_by_sqlite(path)) continue;
    throw InputError(path.string(), "",
                     "would be overwritten, but the folder has no results of croon; choose another "
                     "folder with --out");
  }
}

/// The folder, created if missing. Throws InputError if a run cannot write to it.
fs::path writable(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path, error)) {
    throw InputError(path.string(), "", "expected a folder to write to: " + error.message());
  }
  if (::access(path.c_str(), W_OK | X_OK) != 0) {
    throw InputError(path.string(), "", "expected a writable folder");
  }
  for (const fs::path& to_write : paths_in(path)) {
    const fs::file_status status = fs::status(to_write, error);
    if (!fs::exists(status) || fs::is_regular_file(status)) continue;
    throw InputError(to_write.string(), "",
                     "expected a file or nothing, found " + found_instead_of_file(to_write));
  }
  refuse_files_of_others(path);
  return path;
}

/// Deletes the file or folder `path` if it exists.
void delete_path(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path, error);
  if (error) throw InputError(path.string(), "", "cannot be deleted: " + error.message());
}

/// Deletes the clouds that `write_fused_clouds` left in `folder` and its subfolders, and folders
/// that become empty.
void delete_clouds(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return;
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    paths.push_back(entry.path());
  }
  for (const fs::path& path : paths) {
    delete_clouds(path);
    if (!is_fused_ply(path)) continue;
    // The PLY file identifies both as croon's, so it is deleted last.
    fs::path occupancy = path;
    if (fs::is_regular_file(fs::symlink_status(occupancy.replace_extension(".vdb"), error))) {
      delete_path(occupancy);
    }
    delete_path(path);
  }
  if (fs::is_empty(folder, error)) delete_path(folder);
}

/// Whether the file `path` has these bytes, or is missing if there are no bytes.
bool is_unchanged(const fs::path& path, const Bytes& bytes) {
  std::error_code error;
  return bytes ? file_has(path, *bytes) : !fs::exists(fs::symlink_status(path, error));
}

/// Writes timings.csv in blocks: all rows of millions of trials may not fit into memory.
void write_timings(const TimingsStore& timings, const fs::path& path) {
  constexpr std::size_t kBlockBytes = 1U << 20U;
  Columns<TimingRow> columns;
  columns.add(id_columns(), &TimingRow::id)
      .add({"step"}, &TimingRow::step)
      .add({"seconds"}, &TimingRow::seconds);
  write_in_parts(path, [&](const auto& append) {
    std::string block = csv_header(columns.columns());
    timings.for_each([&](const TimingRow& row) {
      block += csv_line(columns.columns(), columns.cells(row));
      if (block.size() < kBlockBytes) return;
      append(block);
      block.clear();
    });
    append(block);
  });
}

}  // namespace

fs::path merged_store_path(const fs::path& folder) {
  return store_path(folder).string() + ".merged";
}

bool is_result_of_run(const fs::path& path) {
  std::error_code error;
  const fs::path folder = path.parent_path();
  const std::vector<fs::path> results = paths_in(folder);
  if (std::find(results.begin(), results.end(), path) == results.end()) return false;
  return fs::exists(store_path(folder), error) || is_manifest(folder / kManifest);
}

std::string left_out_times_text(const fs::path& folder) {
  std::error_code error;
  const fs::path times = folder / kTimings;
  if (fs::exists(timings_path(folder), error) || !fs::exists(times, error)) return "";
  return printable(times.string()) + ": its wall times are left out: they are read from " +
         timings_path(folder).filename().string() + ", which is missing\n";
}

OutputFolder::OutputFolder(const fs::path& path) : path_(writable(path)), lock_(path_) {}

void OutputFolder::clear() const {
  delete_clouds(file(kClouds));
  // The manifest last: its presence marks the other files as croon's (is_result_of_run), also after
  // a kill in between.
  const fs::path manifest = file(kManifest);
  for (const fs::path& path : paths_in(path_)) {
    if (path != manifest) delete_path(path);
  }
  delete_path(manifest);
}

void OutputFolder::write_reports(const Results& results, const TimingsStore& timings,
                                 const std::string& manifest) const {
  bool is_same = true;
  for (const ResultFile& result : result_files()) {
    const Bytes bytes = result.bytes(results);
    if (is_same && !is_unchanged(file(result.name), bytes)) {
      // Before the first table changes: a run killed here leaves no pictures of other results.
      is_same = false;
      delete_clouds(file(kClouds));
      delete_path(file(kPicture));
      delete_path(file(kReport));
    }
    bytes ? write_whole_file(file(result.name), *bytes) : delete_path(file(result.name));
  }
  // Without rows, an earlier file is not replaced: the wall times in it exist nowhere else.
  std::error_code error;
  if (!timings.is_empty() || !fs::exists(file(kTimings), error)) {
    write_timings(timings, file(kTimings));
  }
  write_whole_file(file(kManifest), manifest);
}

}  // namespace croon::experiments
