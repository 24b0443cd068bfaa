#pragma once

#include <string>

#include "experiments/file/patched_pipeline.hpp"

namespace croon::experiments {

/// Puts `value` in the place of what `path` leads to: "step", "step.key" or "step.key.key". Nothing
/// is merged. A step that takes another's place keeps its name unless it has one of its own.
/// Returns why the path leads nowhere, or nothing.
std::string replace_value(PatchedPipeline& pipeline, const std::string& path,
                          const params::Node& value, const Catalogue& catalogue);

}  // namespace croon::experiments
