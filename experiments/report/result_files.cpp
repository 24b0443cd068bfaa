#include "experiments/report/result_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_set>

#include "experiments/report/result_list.hpp"
#include "experiments/report/result_tables.hpp"
#include "experiments/store/bounded_json.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/ply_file.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

using Bytes = std::optional<std::string>;

constexpr const char* kManifest = "manifest.json";

/// The files of the store, and of the one left by a merge that was killed.
std::vector<fs::path> store_paths_in(const fs::path& folder) {
  std::vector<fs::path> paths = store_files(store_path(folder));
  const std::vector<fs::path> merged = store_files(merged_store_path(folder));
  paths.insert(paths.end(), merged.begin(), merged.end());
  return paths;
}

/// The paths of the store and of all other files in a folder of results.
std::vector<fs::path> paths_in(const fs::path& folder) {
  std::vector<fs::path> paths = store_paths_in(folder);
  for (const ResultFile& file : result_files()) paths.push_back(folder / file.name);
  for (const char* name : {kManifest, kTimings, kPicture}) paths.push_back(folder / name);
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
  std::vector<fs::path> changed = store_paths_in(folder);
  changed.push_back(folder / kTimings);
  std::error_code error;
  for (const fs::path& path : changed) {
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
  const std::vector<fs::path> of_store = store_paths_in(folder);
  for (const fs::path& path : paths) {
    if (!fs::exists(path, error)) continue;
    // A run killed before it created a store leaves no manifest.
    const bool is_of_store = std::find(of_store.begin(), of_store.end(), path) != of_store.end();
    if (is_of_store && is_left_by_sqlite(path)) continue;
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

/// The cells of a line of a CSV file, as written.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') is_quoted = !is_quoted;
    c == ',' && !is_quoted ? void(cells.emplace_back()) : cells.back().push_back(c);
  }
  return cells;
}

/// Whether `line` is a row of timings.csv as croon writes it. The file is outside the store and not
/// checked elsewhere.
bool is_timing(const std::string& line) {
  constexpr std::size_t kTrial = 3, kSeconds = 5;
  const std::vector<std::string> cells = cells_of(line);
  if (cells.size() != kSeconds + 1 || printable(line) != line) return false;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i == kTrial || i == kSeconds) continue;
    const std::size_t first = cells[i].find_first_not_of('"');
    if (first != std::string::npos &&
        std::string(kFormulaSigns).find(cells[i][first]) != std::string::npos)
      return false;
  }
  const auto is_number = [](const std::string& cell, auto value) {
    const char* const end = cell.data() + cell.size();
    const auto read = std::from_chars(cell.data(), end, value);
    return read.ec == std::errc() && read.ptr == end;
  };
  return is_number(cells[kTrial], 0) && is_number(cells[kSeconds], 0.0);
}

/// Calls `use` with each complete line of the file `path`, if it exists. Lines longer than names of
/// `kMaxNameBytes` allow, as in a damaged file, are skipped.
void for_each_line(const fs::path& path, const std::function<void(const std::string&)>& use) {
  constexpr std::streamsize kMaxLineBytes = 10 * kMaxNameBytes;
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return;
  std::ifstream stream;
  if (fs::is_regular_file(path, error)) stream.open(path, std::ios::binary);
  if (!stream.is_open()) throw UnavailableFile(path.string(), "", "expected a readable file");
  std::string line(kMaxLineBytes, '\0');
  while (stream.getline(line.data(), kMaxLineBytes) || stream.gcount() > 0) {
    if (stream.eof()) return;  // Incomplete line.
    if (stream.good()) {
      use(line.substr(0, static_cast<std::size_t>(stream.gcount()) - 1));
      continue;
    }
    stream.clear();
    stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
}

/// The number of bytes of the complete lines of the file `path`, which has `size` bytes. Reads only
/// its end: for millions of trials the file has gigabytes.
std::uintmax_t bytes_of_whole_lines(const fs::path& path, std::uintmax_t size) {
  std::ifstream stream(path, std::ios::binary);
  std::string block(1U << 16U, '\0');
  for (std::uintmax_t end = size; end > 0;) {
    const std::uintmax_t bytes = std::min<std::uintmax_t>(end, block.size());
    stream.seekg(static_cast<std::streamoff>(end - bytes));
    if (!stream.read(block.data(), static_cast<std::streamsize>(bytes))) break;
    const std::size_t newline = block.rfind('\n', bytes - 1);
    if (newline != std::string::npos) return end - bytes + newline + 1;
    end -= bytes;
  }
  return 0;
}

/// The cells of a row of timings.csv that identify its trial.
std::string trial_cells(const std::string& row) {
  return row.substr(0, row.rfind(',', row.rfind(',') - 1));
}

/// Truncates timings.csv after its last complete line; writes the header if there is none.
void repair(const fs::path& path) {
  const std::string header = timings_csv({});
  if (!file_begins_with(path, header)) return write_whole_file(path, header);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  const std::uintmax_t whole = bytes_of_whole_lines(path, size);
  if (!error && whole != size) fs::resize_file(path, whole, error);
  if (error) throw InputError(path.string(), "", "cannot be written: " + error.message());
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

void OutputFolder::write_reports(const Results& results, const std::string& manifest) const {
  bool is_same = true;
  for (const ResultFile& result : result_files()) {
    const Bytes bytes = result.bytes(results);
    if (is_same && !is_unchanged(file(result.name), bytes)) {
      // Before the first table changes: a run killed here leaves no pictures of other results.
      is_same = false;
      delete_clouds(file(kClouds));
      delete_path(file(kPicture));
    }
    bytes ? write_whole_file(file(result.name), *bytes) : delete_path(file(result.name));
  }
  write_whole_file(file(kManifest), manifest);
}

TimingsFile::TimingsFile(const fs::path& path) : path_(path) {
  repair(path);
  stream_.open(path, std::ios::binary | std::ios::app);
  if (!stream_) throw InputError(path.string(), "", "cannot be written");
}

void TimingsFile::add(const std::vector<TimingRow>& rows) {
  rows_.insert(rows_.end(), rows.begin(), rows.end());
}

void TimingsFile::flush() {
  stream_ << timings_csv(rows_).substr(timings_csv({}).size()) << std::flush;
  rows_.clear();
  if (!stream_) throw InputError(path_.string(), "", "cannot be written");
}

std::set<std::string> last_timed_trials(const fs::path& path) {
  constexpr std::uintmax_t kEnd = 1U << 14U;
  std::set<std::string> trials;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) return trials;
  stream.seekg(static_cast<std::streamoff>(size - std::min(size, kEnd)));
  std::string line;
  std::getline(stream, line);  // The header or a partial line.
  while (std::getline(stream, line) && !stream.eof()) {
    if (is_timing(line)) trials.insert(trial_cells(line));
  }
  return trials;
}

std::string timed_trial(const TrialId& id) {
  return trial_cells(timings_csv({{id, "", 0.0}}).substr(timings_csv({}).size()));
}

std::string merged_timings(const std::vector<fs::path>& folders) {
  std::string merged = timings_csv({});
  std::unordered_set<std::string> rows = {merged.substr(0, merged.size() - 1)};
  for (const fs::path& folder : folders) {
    for_each_line(folder / kTimings, [&](const std::string& row) {
      if (is_timing(row) && rows.insert(row).second) merged += row + "\n";
    });
  }
  return merged;
}

}  // namespace croon::experiments
