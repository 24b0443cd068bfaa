#pragma once

#include <string>

#include "framework/stage/catalogue.hpp"

namespace croon {

/// The JSON Schema (draft 2020-12) of an experiment file: its own keys, and every stage of
/// `catalogue` with its parameters, their ranges, words and defaults. Indented by two, ends with a
/// newline. `croon schema` prints this; docs/schema/experiment.schema.json is a copy.
std::string experiment_schema(const Catalogue& catalogue);

}  // namespace croon
