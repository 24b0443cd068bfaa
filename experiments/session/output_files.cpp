#include "experiments/session/output_files.hpp"

#include <unistd.h>

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "experiments/run/given_csv.hpp"
#include "experiments/run/given_velocities.hpp"
#include "experiments/run/pose_file.hpp"
#include "experiments/session/result_files.hpp"
#include "experiments/store/bounded_json.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/point_cloud_file.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// Whether the file `path` is JSON with a key of experiments or of the files that they extend.
bool is_experiment(const fs::path& path) {
  if (path.extension() != ".json") return false;
  const nlohmann::json json = parsed_or_discarded(read_whole_file(path));
  return json.is_object() &&
         (json.contains("dataset") || json.contains("extends") || json.contains("pipeline"));
}

/// The kind of input file of experiments that exists at the path of `file`, such as "a file of
/// starts"; empty if there is none, or if the new bytes are of the same kind.
std::string named_by_experiments(const OutputFile& file) {
  for (const auto& [header, what] :
       {std::pair(velocity_header().c_str(), "a file of velocities"),
        std::pair(kStartHeader, "a file of starts"), std::pair(kPoseHeader, "a file of poses")}) {
    if (file.bytes.rfind(header, 0) != 0 && begins_with_header(file.path, header)) return what;
  }
  return "";
}

/// Describes the existing or reserved file at the path of `file` that must not be replaced; empty
/// if it may be written.
std::string what_must_stay(const OutputFile& file, const std::vector<fs::path>& inputs) {
  const fs::path& path = file.path;
  static const std::set<std::string> of_datasets = {
      "truth.json",      "nominal.json",         "scene_kinds.json",
      "simulation.json", "lidar_cloud_path.txt", "initial_extrinsic.txt"};
  std::error_code error;
  // Even if it does not exist: SQLite would treat it as part of the store.
  if (is_result_of_run(path)) return "a file of the results of a run";
  const fs::file_status status = fs::symlink_status(path, error);
  if (!fs::exists(status)) return "";
  if (fs::is_symlink(status)) return "a link";
  if (!fs::is_regular_file(status)) return found_instead_of_file(path);
  for (const fs::path& input : inputs) {
    if (fs::equivalent(path, input, error)) return "which is read";
  }
  if (of_datasets.count(path.filename().string()) > 0) return "a file of a dataset";
  if (has_point_cloud_suffix(path)) return "a cloud";
  return is_experiment(path) ? "an experiment" : named_by_experiments(file);
}

}  // namespace

void refuse_to_replace(const std::vector<OutputFile>& files, const std::vector<fs::path>& inputs) {
  for (const OutputFile& file : files) {
    const std::string what = what_must_stay(file, inputs);
    if (what.empty()) continue;
    throw InputError("", "--out",
                     "expected a file to write, found " + file.path.string() + ", " + what);
  }
}

void replace_output_files(const std::vector<OutputFile>& files,
                          const std::vector<fs::path>& inputs) {
  refuse_to_replace(files, inputs);
  for (const OutputFile& file : files) write_whole_file(file.path, file.bytes);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "", "cannot be created: " + error.message());
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw InputError(folder.string(), "", "expected a writable folder");
  }
}

void write_output_files(const std::vector<OutputFile>& files) {
  std::vector<const OutputFile*> missing;
  for (const OutputFile& file : files) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(file.path, error))) {
      missing.push_back(&file);
    } else if (!file_has(file.path, file.bytes)) {
      throw InputError("", "--out",
                       "expected a new file, found " + file.path.string() +
                           ", which exists; delete it first, or write to another file");
    }
  }
  for (const OutputFile* file : missing) write_whole_file(file->path, file->bytes);
}

}  // namespace croon::experiments
