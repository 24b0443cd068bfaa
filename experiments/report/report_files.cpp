#include "experiments/report/report_files.hpp"

#include <optional>

#include "experiments/report/plots.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::experiments {
namespace {

using Bytes = std::optional<std::string>;

/// A file of a folder of results.
struct ResultFile {
  const char* name;
  /// Its bytes, std::nullopt if these results have no such file; null if another function writes
  /// it.
  Bytes (*bytes)(const Results& results);
};

constexpr const char* kManifest = "manifest.json";

/// `bytes` of a summary if `rows` is not empty.
template <class Rows>
Bytes if_any(const Rows& rows, std::string (*bytes)(const Summary&), const Summary& summary) {
  return rows.empty() ? std::nullopt : Bytes(bytes(summary));
}

Bytes if_basin(const Results& results, std::string (*bytes)(const Basin&)) {
  return results.basin ? Bytes(bytes(*results.basin)) : std::nullopt;
}

/// Every file that a run writes. A new one is a row here.
const std::vector<ResultFile>& result_files() {
  using R = Results;
  static const std::vector<ResultFile> files = {
      {"trials.csv", [](const R& r) -> Bytes { return trials_csv(r.records); }},
      {"summary.csv", [](const R& r) -> Bytes { return summary_csv(r.summary); }},
      {"summary.json", [](const R& r) -> Bytes { return summary_json(r.summary, r.claims); }},
      {"summary_by_kind.csv",
       [](const R& r) { return if_any(r.summary.scene_kinds, summary_by_kind_csv, r.summary); }},
      {"comparison.csv",
       [](const R& r) { return if_any(r.summary.comparisons, comparison_csv, r.summary); }},
      {"loops.csv", [](const R& r) { return if_any(r.summary.loops, loops_csv, r.summary); }},
      {"basin.csv", [](const R& r) { return if_basin(r, basin_csv); }},
      {"basin.svg", [](const R& r) { return if_basin(r, basin_svg); }},
      {"box_plots.svg", [](const R& r) -> Bytes { return box_plots_svg(r.summary); }},
      {kManifest, nullptr},
      {kTimings, nullptr},
      {kPicture, nullptr}};
  return files;
}

void remove_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) throw InputError(path.string(), "", "cannot be deleted: " + error.message());
}

}  // namespace

std::vector<std::string> result_file_names() {
  std::vector<std::string> names;
  for (const ResultFile& file : result_files()) names.emplace_back(file.name);
  return names;
}

void write_reports(const std::filesystem::path& folder, const Results& results,
                   const std::string& manifest) {
  for (const ResultFile& file : result_files()) {
    if (file.bytes == nullptr) continue;
    const Bytes bytes = file.bytes(results);
    bytes ? write_whole_file(folder / file.name, *bytes) : remove_file(folder / file.name);
  }
  write_whole_file(folder / kManifest, manifest);
}

}  // namespace croon::experiments
