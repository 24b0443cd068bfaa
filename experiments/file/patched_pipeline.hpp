#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// Where in the file a part of a step's JSON comes from; both are JSON pointers.
struct Origin {
  std::string part;   ///< In the step; empty for the whole.
  std::string place;  ///< In the file.
};

/// A step as JSON, put together from the base pipeline and what a variant puts in its place.
struct PatchedStep {
  std::string name;
  std::shared_ptr<const nlohmann::json> value;
  std::vector<Origin> origins;
};

/// A pipeline as JSON that still knows where in the file each part stands. Cheap to copy.
using PatchedPipeline = std::vector<PatchedStep>;

/// The steps of the list `pipeline` with their names. Notes faults in the node.
PatchedPipeline read_steps(const params::Node& pipeline);

/// The step's "name", else its type; notes a fault where it is no name.
std::string read_step_name(const params::Node& step);

/// The step called `name`, or the end.
PatchedPipeline::iterator find_step(PatchedPipeline& pipeline, const std::string& name);

/// Says that there is no step `name`, with the nearest that there is.
std::string no_step(const PatchedPipeline& pipeline, const std::string& name);

/// Notes that `origin.part` of a step now stands at `origin.place`.
void set_origin(std::vector<Origin>& origins, const Origin& origin);

/// Takes the step called `name` out. Returns why that is not possible, or nothing.
std::string remove_step(PatchedPipeline& pipeline, const std::string& name);

/// The pipeline that the JSON describes; `resolved` is its canonical JSON. Notes faults at their
/// places in `file`.
Pipeline build_pipeline(const PatchedPipeline& pipeline, const Catalogue& catalogue,
                        const std::string& file, std::vector<Fault>& faults, std::string& resolved);

}  // namespace croon::experiments
