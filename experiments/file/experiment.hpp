#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/file/claims.hpp"
#include "experiments/file/start_rule.hpp"
#include "framework/params/slot.hpp"
#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/catalogue.hpp"
#include "framework/stage/dataset.hpp"

namespace croon::experiments {

/// The name of the step that takes the poses of a file.
inline constexpr const char* kPosesStep = "poses";

/// More variants than an experiment has.
inline constexpr std::size_t kMaxVariants = 10000;

/// A file of poses `T_reference_sensor`, as a variant names it.
struct PosesFile {
  std::string name;     ///< Empty if there is none.
  std::string file;     ///< The experiment file that names it,
  std::string pointer;  ///< and the JSON pointer there.
};

/// One pipeline of an experiment.
struct Variant {
  std::string name;  ///< "base" for the base pipeline.
  Pipeline pipeline;
  std::string resolved;  ///< Canonical JSON of the pipeline with all its parameters.
  PosesFile poses = {};  ///< The poses from which the pipeline goes on; see `resolve_poses`.
};

/// How near the truth a trial must end to count as `success`.
struct SuccessBounds {
  double rotation_deg = 0.5;
  double translation_m = 0.1;
};

/// A file that an experiment was read from.
struct ExperimentFile {
  std::string path;  ///< The name of the first file; for extended files, the path as written.
  std::string sha256;
};

/// An experiment file, read, checked, and with its variants and grid multiplied out.
struct Experiment {
  std::string file;
  std::string name;
  std::string description;  ///< The question it answers; may be empty.
  params::Slot<Dataset> dataset;
  StartRule starts;
  std::string starts_file = {};  ///< In which they are written: the file, or one that it extends.
  std::uint64_t seed = 1;
  SuccessBounds success;
  int scenes_per_trial = 1;  ///< See `grouped`.
  bool loops = false;        ///< Sensors are calibrated to each other too (scenes_of).
  std::vector<Claim> claims;
  std::vector<Quoted> quoted;     ///< Rows of other methods.
  std::vector<Variant> variants;  ///< The base first, then in the order of the file.
  std::vector<ExperimentFile> files;
  /// JSON of the file's keys, with those of the files that it extends.
  std::string merged;
};

/// The experiment that the JSON file `path` describes, with its stages from `catalogue`. The keys
/// of `workloads`, files of the same form that need no pipeline, replace its keys, and their names
/// are appended to its name. Strict: throws one InputError with every fault of all files. Does not
/// look at the data.
Experiment load_experiment(const std::filesystem::path& path, const Catalogue& catalogue,
                           const std::vector<std::filesystem::path>& workloads = {});

/// The same from JSON `text`; `path` is its name in errors, and paths in it are relative to the
/// folder of `path`.
Experiment parse_experiment(const std::string& text, const std::filesystem::path& path,
                            const Catalogue& catalogue,
                            const std::vector<std::filesystem::path>& workloads = {});

/// Throws InputError with every fault of an experiment file, or of a workload: the same without a
/// pipeline.
void validate_experiment(const std::filesystem::path& path, const Catalogue& catalogue);

/// Where `step` is, for faults: `the step "refine" of the variant "one plane"`, or the step alone
/// if there is one variant.
std::string place_of(const Experiment& experiment, const Variant& variant, const NamedStep& step);

/// Canonical JSON of the experiment: every key with its default, claims expanded, each variant with
/// its whole pipeline.
std::string experiment_json(const Experiment& experiment);

/// The experiment that `experiment_json` wrote, in this version or an earlier one: without its
/// variants, and with stages that are names and parameters only. `file` is where `text` comes from.
/// Throws InputError if the text is damaged.
Experiment read_experiment_json(const std::string& text, const std::string& file);

/// Canonical JSON of the bounds.
std::string success_json(const SuccessBounds& bounds);

/// The JSON Schema (draft 2020-12) of an experiment file: its keys, and every stage of `catalogue`
/// with its parameters, their ranges, words and defaults. Indented by two, ends with a newline.
/// `croon schema` prints this; docs/schema/experiment.schema.json is a copy.
std::string experiment_schema(const Catalogue& catalogue);

}  // namespace croon::experiments
