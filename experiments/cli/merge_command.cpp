#include "experiments/cli/commands.hpp"

#include <algorithm>
#include <memory>

#include "experiments/analysis/results.hpp"
#include "experiments/cli/command.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/report/result_sections.hpp"
#include "experiments/session/result_files.hpp"
#include "experiments/store/manifest.hpp"
#include "experiments/store/store.hpp"
#include "experiments/store/store_header.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMergeRemedy = "only results of the same experiment can be merged";

bool is_same_folder(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::equivalent(a, b, error);
}

bool is_among(const std::vector<fs::path>& folders, const fs::path& folder) {
  return std::any_of(folders.begin(), folders.end(),
                     [&](const fs::path& other) { return is_same_folder(other, folder); });
}

/// The folders, each once.
std::vector<fs::path> without_repeats(const std::vector<fs::path>& folders) {
  std::vector<fs::path> once;
  for (const fs::path& folder : folders) {
    if (!is_among(once, folder)) once.push_back(folder);
  }
  return once;
}

/// Locks all folders except `out`, so that no run writes to a folder while it is read.
std::vector<std::unique_ptr<FolderLock>> locked(const std::vector<fs::path>& folders,
                                                const fs::path& out) {
  std::vector<std::unique_ptr<FolderLock>> locks;
  for (const fs::path& folder : folders) {
    if (!is_same_folder(folder, out)) locks.push_back(std::make_unique<FolderLock>(folder));
  }
  return locks;
}

/// The header of a folder of results.
StoreHeader header_in(const fs::path& folder) {
  StoreHeader header = stored_header(store_path(folder));
  if (!header.provenance.empty()) {
    check_reportable(header, store_path(folder).string());
    return header;
  }
  throw InputError(folder.string(), "", "expected a folder with the results of a run");
}

/// A store whose trials are merged, and its header.
struct Part {
  fs::path store;
  StoreHeader header;
};

/// The united header of the folders, whose stores are added to `parts`. Throws InputError with all
/// differences from the first. If the experiment grew between the runs, the latest header is the
/// one with the most trials per sensor and scene and, among equals, the most trials in total.
StoreHeader header_of_all(const std::vector<fs::path>& folders, bool same_build,
                          std::vector<Part>& parts) {
  std::vector<Fault> faults;
  StoreHeader header;
  for (const fs::path& folder : folders) {
    collect_faults(faults, [&] {
      const StoreHeader& other =
          parts.emplace_back(Part{store_path(folder), header_in(folder)}).header;
      if (header.provenance.empty()) header = other;
      refuse_differences(store_path(folder).string(), header, other, kMergeRemedy);
      if (same_build) refuse_other_builds(store_path(folder).string(), other, header, kMergeRemedy);
      // Reports omit trials beyond StoreHeader::trials, so this number is compared first.
      const auto size = [](const StoreHeader& of) {
        return std::pair(of.trials, planned_trials(of.manifest));
      };
      const bool is_later = size(other) > size(header);
      header = is_later ? united(other, header) : united(header, other);
    });
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return header;
}

/// `header` plus the names of variants, scenes and sensors that the store contains from earlier
/// merges. Entries that are no longer in the experiment are kept, but omitted from reports.
StoreHeader with_names_of(const Part& merged_before, const StoreHeader& header) {
  StoreHeader old = merged_before.header;
  refuse_differences(merged_before.store.string(), old, header, kMergeRemedy);
  for (auto names : {&StoreHeader::variants, &StoreHeader::scenes, &StoreHeader::sensors}) {
    for (StoredName& name : old.*names) name.is_current = false;
  }
  return united(header, old);
}

void remove_files(const std::vector<fs::path>& files) {
  std::error_code ignored;
  for (const fs::path& file : files) fs::remove(file, ignored);
}

/// The header of a merge of `folders` into `out`, whose stores are added to `parts`. Throws
/// InputError if they do not belong together.
StoreHeader merged_header(const std::vector<fs::path>& folders, const fs::path& out,
                          bool same_build, std::vector<Part>& parts) {
  StoreHeader header = header_of_all(folders, same_build, parts);
  header.manifest = manifest_with_variants(header.manifest, header.variants);
  const fs::path path = store_path(out);
  if (!has_store(path) || is_among(folders, out)) return header;
  const Part& merged_before = parts.emplace_back(Part{path, stored_header(path)});
  const StoreHeader all = with_names_of(merged_before, header);
  if (same_build) refuse_other_builds(path.string(), merged_before.header, header, kMergeRemedy);
  return all;
}

/// Writes the trials of `parts`, including the old store of `out` if there is one, to the store of
/// `out`. The old store is replaced only when the new one is complete.
void merge_stores(const std::vector<Part>& parts, const StoreHeader& header, const fs::path& out) {
  const fs::path merged = merged_store_path(out);
  remove_files(store_files(merged));
  try {
    {
      Store store(merged, header);
      for (const Part& part : parts) {
        reading(part.store, [&] { store.merge(part.store, part.header); });
      }
    }
    rewrite_in_order(merged);
  } catch (...) {
    remove_files(store_files(merged));
    throw;
  }
  replace_store(store_path(out), merged);
}

/// The folders to create for `out`, innermost first.
std::vector<fs::path> missing_folders(const fs::path& out) {
  std::vector<fs::path> missing;
  for (fs::path folder = fs::absolute(out); !fs::exists(folder); folder = folder.parent_path()) {
    missing.push_back(folder);
  }
  return missing;
}

/// "12 of 100 trials are missing", or empty if all are there.
std::string missing_text(const Results& results) {
  if (results.records.size() >= results.planned) return "";
  return std::to_string(results.planned - results.records.size()) + " of " +
         std::to_string(results.planned) + " trials of the experiment are missing\n";
}

}  // namespace

int merge_command(const MergeOptions& options, std::ostream& out) {
  const std::vector<fs::path> folders = without_repeats(options.folders);
  const auto locks = locked(folders, options.out);
  std::vector<Part> parts;
  const StoreHeader header = merged_header(folders, options.out, options.same_build, parts);
  const std::vector<fs::path> made = missing_folders(options.out);
  const OutputFolder folder(options.out);
  std::vector<fs::path> all = folders;
  if (!is_among(all, options.out)) all.push_back(options.out);
  std::string hosts, left_out;
  try {
    // Before the store is written: a refused merge must change nothing.
    hosts = hosts_json(all);
    for (const fs::path& part : all) {
      const TimingsStore checked(timings_path(part), Access::read);
      left_out += left_out_times_text(part);
    }
    merge_stores(parts, header, options.out);
  } catch (...) {
    remove_files(made);
    throw;
  }
  const Results results = read_results(options.out, Content::trials_and_steps);
  TimingsStore timings(folder.timings(), Access::write);
  for (const fs::path& part : folders) {
    if (!is_same_folder(part, options.out)) timings.merge(timings_path(part));
  }
  folder.write_reports(results, timings, merged_manifest(results.manifest, hosts));
  const std::string missing = missing_text(results);
  out << result_text(results, options.colours) << missing << left_out << "Results are in "
      << printable(options.out.string()) << "\n";
  return has_failed_trials(results) || !missing.empty() ? 3 : 0;
}

namespace {

class MergeCommand final : public Command {
 public:
  std::string sentence() const override { return "Merge the results of shards."; }

  void add_options(CLI::App& command) override {
    add_path(command, "DIR", options_.folders, "Folders of results.")->required();
    add_path(command, "--out", options_.out, "Folder to write to.")->required();
    command.add_flag("--same-build", options_.same_build, "Refuse trials of different builds.");
  }

  int run(const Console& console) override {
    options_.colours = console.colours;
    return merge_command(options_, console.out);
  }

 private:
  MergeOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_merge_command() { return std::make_unique<MergeCommand>(); }

}  // namespace croon::experiments
