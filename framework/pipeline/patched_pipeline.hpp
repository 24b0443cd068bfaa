#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon {

/// The file and position where a part of a step's JSON was written.
struct Origin {
  std::string part;  ///< JSON pointer in the step; empty for the whole step.
  std::string file;
  std::string pointer;  ///< JSON pointer in the file.
};

/// A step as JSON, composed of the base pipeline and the changes of a variant.
struct PatchedStep {
  std::string name;
  std::shared_ptr<const nlohmann::json> value;
  std::vector<Origin> origins;
};

/// A pipeline as JSON that records where each part was written: read from a list of steps, changed
/// part by part, and then built. Cheap to copy.
using PatchedPipeline = std::vector<PatchedStep>;

/// The maximum number of steps in a list: far above that of any method, and quick to check.
inline constexpr std::size_t kMaxSteps = 1000;

/// The steps of the list `pipeline` with their names. Notes faults in the node.
PatchedPipeline read_steps(const params::Node& pipeline);

// The functions below that return a string return an empty one on success; otherwise they change
// nothing and return the reason.

/// Inserts the step `step` before or after the step called `anchor`.
std::string insert_step(PatchedPipeline& pipeline, const std::string& anchor, bool is_after,
                        const params::Node& step);

/// Removes the step called `name`.
std::string remove_step(PatchedPipeline& pipeline, const std::string& name);

/// Replaces the value at `path`, "step", "step.key" or "step.key.key", with `value`. Nothing is
/// merged. A step that replaces another keeps its name unless `value` has a name.
std::string replace_value(PatchedPipeline& pipeline, const std::string& path,
                          const params::Node& value, const Catalogue& catalogue);

/// Builds the pipeline that the JSON describes. Adds all faults to `faults`, each with the file and
/// the pointer where the value was written.
Pipeline build_pipeline(const PatchedPipeline& pipeline, const Catalogue& catalogue,
                        std::vector<Fault>& faults);

/// The fault `message` of the step, at the position where the step was written.
Fault fault_of_step(const PatchedStep& step, const std::string& message);

/// A fault, at the position where the step was written, for each extra that a step of `pipeline`
/// needs and that no earlier step provides, or provides with another type. `built` is the result of
/// `build_pipeline` without faults.
std::vector<Fault> unmet_needs(const PatchedPipeline& pipeline, const Pipeline& built);

}  // namespace croon
