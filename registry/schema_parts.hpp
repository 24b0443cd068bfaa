#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "framework/stage/catalogue.hpp"

namespace croon {

/// `{"$ref": ...}` to the definition `name`: a kind ("icp") or a stage ("icp.icpn").
nlohmann::ordered_json definition(const std::string& name);

/// The values that a parameter takes, with its sentence and default.
nlohmann::ordered_json parameter_schema(const params::ParameterDoc& parameter);

/// The JSON object of one stage.
nlohmann::ordered_json stage_schema(const StageEntry& entry);

/// The keys of an experiment file.
nlohmann::ordered_json experiment_properties(const Catalogue& catalogue);

/// Those of them that say what the results are held against: "expect" and "quoted".
nlohmann::ordered_json claims_properties();

}  // namespace croon
