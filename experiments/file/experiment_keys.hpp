#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "framework/params/group.hpp"

namespace croon::experiments {

/// The name of an experiment, which is also the name of its folder.
inline const params::NameRule kFolderName = {
    "_.-", "a name for a folder: letters, digits, _ . and -, not starting with a dot", "."};

/// A variant's name. It is used in paths and in CSV files, in which spreadsheets interpret a cell
/// that begins with a sign as a formula; see `check_names` for scenes and sensors.
inline const params::NameRule kVariantName = {
    "_.-+=() ",
    "a name of letters, digits, spaces and _ . - + = ( ), not starting with a dot or a sign",
    ". =+-", " "};

/// Definitions in the JSON Schema for values of several forms.
inline constexpr const char* kExtendsDefinition = "extends";
inline constexpr const char* kPipelineDefinition = "pipeline";
inline constexpr const char* kStepDefinition = "step";
inline constexpr const char* kReplacementsDefinition = "replacements";
inline constexpr const char* kGridDefinition = "grid";

/// A step that a variant inserts, before or after a step of the pipeline.
struct Insertion {
  std::string before;
  std::string after;
  std::optional<params::Node> step;
};

/// An element of "variants".
struct VariantKeys {
  std::string name;
  std::string poses;
  std::optional<params::Node> pipeline;
  std::vector<Insertion> insert;
  std::vector<std::string> remove;
  std::optional<params::Node> replace;
};

/// The keys of an experiment file: those kept in an Experiment, and those from which its variants
/// are made.
struct ExperimentKeys : Experiment {
  std::optional<params::Node> extends;
  std::optional<params::Node> pipeline;
  std::vector<VariantKeys> variant_keys;
  std::optional<params::Node> grid;
};

/// The single description of an experiment file, from which the loader, the JSON Schema, canonical
/// JSON and the reader of stored experiments are derived. A new key is a row here.
const params::Table<ExperimentKeys>& experiment_table();

/// The rows that are kept in an Experiment.
const params::Table<Experiment>& kept_table();

/// The same rows, none of them required: the keys of a workload.
const params::Table<Experiment>& workload_table();

/// The variants of the experiment `root`: the base pipeline first, then those described by `keys`,
/// each expanded over the grid. A point of the grid is called `variant/point/point`, with a point
/// for each axis. Faults are added to `faults`; a fault shared by variants is added for each.
std::vector<Variant> make_variants(const ExperimentKeys& keys, const params::Node& root,
                                   const Catalogue& catalogue, std::vector<Fault>& faults);

}  // namespace croon::experiments
