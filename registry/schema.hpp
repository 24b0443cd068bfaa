#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "framework/stage/catalogue.hpp"

namespace croon {

/// `{"$ref": ...}` to the definition `name`: a kind of stage ("icp") or a stage ("icp.icpn").
nlohmann::ordered_json definition(const std::string& name);

/// The JSON Schema of one parameter: its valid values, description and default.
nlohmann::ordered_json parameter_schema(const params::ParameterDoc& parameter);

/// The JSON Schema of an object whose keys are `members` and follow `rules`.
nlohmann::ordered_json object_schema(const std::vector<params::ParameterDoc>& members,
                                     const std::vector<params::KeyRule>& rules);

/// The definitions of a JSON Schema: each kind of stage of `catalogue`, and each stage with the
/// ranges, words and defaults of its parameters.
nlohmann::ordered_json stage_definitions(const Catalogue& catalogue);

}  // namespace croon
