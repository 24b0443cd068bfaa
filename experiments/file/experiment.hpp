#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/file/claims.hpp"
#include "experiments/file/start_rule.hpp"
#include "framework/params/slot.hpp"
#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/catalogue.hpp"
#include "framework/stage/dataset.hpp"

namespace croon::experiments {

/// The name of the step that sets the poses from a file.
inline constexpr const char* kPosesStep = "poses";

/// The maximum number of variants of an experiment.
inline constexpr std::size_t kMaxVariants = 10000;

/// A file of poses `T_reference_sensor` named by a variant.
struct PosesFile {
  std::string name;     ///< Empty if there is no file.
  std::string file;     ///< The experiment file with the name,
  std::string pointer;  ///< and the JSON pointer in it.
};

/// One pipeline of an experiment.
struct Variant {
  std::string name;  ///< "base" for the base pipeline.
  Pipeline pipeline;
  PosesFile poses = {};  ///< The initial poses of the pipeline; see `resolve_poses`.
};

/// The maximum error of a trial that counts as `success`.
struct SuccessBounds {
  double rotation_deg = 0.5;
  double translation_m = 0.1;
};

/// A file that an experiment was read from.
struct ExperimentFile {
  std::string path;  ///< The name of the first file; for extended files, the path as written.
  std::string sha256;
};

/// An experiment file, read and checked, with variants and grid expanded.
struct Experiment {
  std::string file;
  std::string name;
  std::string description;  ///< The question that it answers; may be empty.
  params::Slot<Dataset> dataset;
  StartRule starts;
  std::string starts_file =
      {};  ///< The file with this key: the experiment file or one that it extends.
  std::uint64_t seed = 1;
  SuccessBounds success;
  int scenes_per_trial = 1;  ///< See `scene_groups`.
  bool loops = false;        ///< Also calibrates sensors to each other (`scene_groups`).
  std::vector<Claim> claims;
  std::vector<Quoted> quoted;     ///< Published results of other methods.
  std::vector<Variant> variants;  ///< The base first, then in the order of the file.
  std::vector<ExperimentFile> files;
  /// All keys of the file and of the files that it extends.
  std::shared_ptr<const nlohmann::json> merged;
  std::vector<Fault> notes;  ///< Former names of keys, each once.
};

/// Reads the experiment in the JSON file `path`, with stages from `catalogue`. The keys of
/// `workloads`, files of the same form that need no pipeline, replace its keys, and their names are
/// appended to its name. Throws one InputError with all faults of all files, including unknown
/// keys. Does not read the data.
Experiment load_experiment(const std::filesystem::path& path, const Catalogue& catalogue,
                           const std::vector<std::filesystem::path>& workloads = {});

/// The same from the JSON `text`; `path` is its name in errors, and paths in it are relative to the
/// folder of `path`.
Experiment parse_experiment(const std::string& text, const std::filesystem::path& path,
                            const Catalogue& catalogue,
                            const std::vector<std::filesystem::path>& workloads = {});

/// Throws InputError with all faults of an experiment file, or of a workload, which is the same
/// without a pipeline. Returns the former names of keys, each once.
std::vector<Fault> validate_experiment(const std::filesystem::path& path,
                                       const Catalogue& catalogue);

/// The location of `step` in messages: `the step "refine" of the variant "one plane"`, without the
/// variant if there is only one.
std::string location_of(const Experiment& experiment, const Variant& variant,
                        const NamedStep& step);

/// Canonical JSON of the experiment: every key with its default, claims expanded, each variant with
/// its complete pipeline.
nlohmann::ordered_json experiment_json(const Experiment& experiment);

/// Reads `stored`, JSON written by `experiment_json` in this or an earlier version. The result has
/// no variants, and its stages have only names and parameters. `file` is the origin of `stored`.
/// Throws InputError if it is damaged.
Experiment read_experiment_json(const nlohmann::json& stored, const std::string& file);

/// Canonical JSON of the bounds.
std::string success_json(const SuccessBounds& bounds);

/// The JSON Schema (draft 2020-12) of an experiment file: its keys, and every stage of `catalogue`
/// with its parameters, ranges, choices and defaults. Indented by two, ends with a newline. `croon
/// schema` prints it; docs/schema/experiment.schema.json is a copy.
std::string experiment_schema(const Catalogue& catalogue);

}  // namespace croon::experiments
