#include "experiments/cli/merge_command.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "experiments/cli/output_folder.hpp"
#include "experiments/cli/report_files.hpp"
#include "experiments/cli/results_folder.hpp"
#include "experiments/cli/timings_file.hpp"
#include "experiments/engine/manifest.hpp"
#include "experiments/engine/store.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRemedy = "results of one experiment alone can be merged";

/// Experiments grow: the later state is the one with more trials, then more variants.
bool is_later(const StoreHeader& a, const StoreHeader& b) {
  return std::pair(a.trials, a.variants.size()) > std::pair(b.trials, b.variants.size());
}

/// The header of all the folders; the differences of each from the first are faults.
StoreHeader header_of_all(const std::vector<fs::path>& folders) {
  std::vector<Fault> faults;
  StoreHeader header;
  for (const fs::path& folder : folders) {
    collect_faults(faults, [&] {
      const fs::path store = store_path(folder);
      const StoreHeader other = stored_header(store);
      if (other.provenance.empty()) {
        throw InputError(folder.string(), "", "expected a folder with the results of a run");
      }
      if (header.provenance.empty()) header = other;
      refuse_differences(store.string(), header, other, kRemedy);
      header = is_later(other, header) ? united(other, header) : united(header, other);
    });
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return header;
}

/// The folders whose trials are put together, each once: what is in `out` already, and those
/// given.
std::vector<fs::path> sources(const MergeOptions& options) {
  std::vector<fs::path> folders;
  if (fs::exists(store_path(options.out))) folders.push_back(options.out);
  for (const fs::path& folder : options.folders) {
    const auto is_folder = [&](const fs::path& other) {
      std::error_code error;
      return fs::equivalent(folder, other, error);
    };
    if (std::none_of(folders.begin(), folders.end(), is_folder)) folders.push_back(folder);
  }
  return folders;
}

/// Keeps the folders but `out` from other processes: no run may write to what is read.
std::vector<std::unique_ptr<FolderLock>> locked(const std::vector<fs::path>& folders,
                                                const fs::path& out) {
  std::vector<std::unique_ptr<FolderLock>> locks;
  for (const fs::path& folder : folders) {
    if (folder != out) locks.push_back(std::make_unique<FolderLock>(folder));
  }
  return locks;
}

void remove_files(const std::vector<fs::path>& files) {
  std::error_code ignored;
  for (const fs::path& file : files) fs::remove(file, ignored);
}

/// Writes the store of all `folders` beside `path` and puts it there when it is whole.
void merge_stores(const std::vector<fs::path>& folders, const StoreHeader& header,
                  const fs::path& path) {
  const fs::path merged = path.string() + ".merged";
  remove_files(store_files(merged));
  try {
    {
      Store store(merged, header);
      for (const fs::path& folder : folders) {
        store.merge(store_path(folder), stored_header(store_path(folder)));
      }
    }
    rewrite_in_order(merged);
  } catch (...) {
    remove_files(store_files(merged));
    throw;
  }
  remove_files(store_files(path));
  fs::rename(merged, path);
}

/// "12 of 100 trials are missing", or nothing.
std::string missing_text(const Results& results) {
  if (results.records.size() >= results.planned) return "";
  return std::to_string(results.planned - results.records.size()) + " of " +
         std::to_string(results.planned) + " trials of the experiment are missing\n";
}

}  // namespace

int merge_command(const MergeOptions& options, std::ostream& out) {
  const std::vector<fs::path> folders = sources(options);
  const StoreHeader header = header_of_all(folders);
  const bool is_new = !fs::exists(options.out);
  const auto locks = locked(folders, options.out);
  const OutputFolder folder(options.out);
  try {
    merge_stores(folders, header, store_path(options.out));
  } catch (const InputError&) {
    if (is_new) remove_files({options.out});
    throw;
  }
  const Results results = read_results(options.out);
  write_reports(options.out, results, merged_manifest(results.manifest, folders));
  merge_timings(folders, options.out / kTimings);
  const std::string missing = missing_text(results);
  out << result_text(results, options.colours) << missing << "Results are in "
      << options.out.string() << "\n";
  return has_failed_trials(results) || !missing.empty() ? 3 : 0;
}

}  // namespace croon::experiments
