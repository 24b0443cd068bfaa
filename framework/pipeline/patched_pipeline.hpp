#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon {

/// Where a part of a step's JSON was written.
struct Origin {
  std::string part;  ///< JSON pointer in the step; empty for the whole.
  std::string file;
  std::string pointer;  ///< JSON pointer in the file.
};

/// A step as JSON, put together from the base pipeline and what a variant puts into it.
struct PatchedStep {
  std::string name;
  std::shared_ptr<const nlohmann::json> value;
  std::vector<Origin> origins;
};

/// A pipeline as JSON that knows where each part was written: it is read from a list of steps,
/// changed part by part, and then built. Cheap to copy.
using PatchedPipeline = std::vector<PatchedStep>;

/// The most steps that a list may have: far more than a method has, few enough to be checked at
/// once.
inline constexpr std::size_t kMostSteps = 1000;

/// The steps of the list `pipeline` with their names. Notes faults in the node.
PatchedPipeline read_steps(const params::Node& pipeline);

// The functions below that return a string change nothing if they return why they cannot, and
// return an empty string otherwise.

/// Inserts the step `step` before the step called `anchor`, or after it.
std::string insert_step(PatchedPipeline& pipeline, const std::string& anchor, bool is_after,
                        const params::Node& step);

/// Removes the step called `name`.
std::string remove_step(PatchedPipeline& pipeline, const std::string& name);

/// Puts `value` in the place of what `path` leads to: "step", "step.key" or "step.key.key". Nothing
/// is merged. A step that replaces another keeps its name unless it has one of its own.
std::string replace_value(PatchedPipeline& pipeline, const std::string& path,
                          const params::Node& value, const Catalogue& catalogue);

/// Builds the pipeline that the JSON describes; `resolved` becomes its canonical JSON. Adds to
/// `faults` what is wrong, each with the file and the pointer where it was written.
Pipeline build_pipeline(const PatchedPipeline& pipeline, const Catalogue& catalogue,
                        std::vector<Fault>& faults, std::string& resolved);

/// The fault `message` of the step, where the step was written.
Fault fault_of_step(const PatchedStep& step, const std::string& message);

/// The extras that steps of `pipeline` take and no step before them gives, or gives with another
/// type: a fault for each, where the step was written. `built` is what `build_pipeline` made of it
/// without faults.
std::vector<Fault> unmet_needs(const PatchedPipeline& pipeline, const Pipeline& built);

}  // namespace croon
