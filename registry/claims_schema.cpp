#include <nlohmann/json.hpp>

#include "registry/claim_keys.hpp"
#include "registry/schema_parts.hpp"

namespace croon {
namespace {

using nlohmann::ordered_json;
using params::ParameterDoc;

/// The object whose keys are `parameters`; what is not required has no default.
ordered_json object_of(const std::vector<ParameterDoc>& parameters) {
  ordered_json properties;
  ordered_json required = ordered_json::array();
  for (const ParameterDoc& parameter : parameters) {
    properties[parameter.key] = parameter_schema(parameter);
    properties[parameter.key].erase("default");
    if (parameter.is_required) required.push_back(parameter.key);
  }
  return {{"type", "object"},
          {"properties", properties},
          {"required", required},
          {"additionalProperties", false}};
}

ordered_json list_of(const ordered_json& items, const std::string& description) {
  return {{"type", "array"}, {"description", description}, {"items", items}};
}

ordered_json expectation_schema() {
  ordered_json schema = object_of(expectation_table().docs());
  schema["properties"]["band"]["minItems"] = 2;
  schema["properties"]["band"]["maxItems"] = 2;
  schema["if"] = {{"properties", {{"statistic", {{"enum", kShareStatistics}}}}}};
  schema["then"] = {{"not", {{"required", {"measure"}}}}};
  schema["else"] = {{"required", {"measure"}}};
  return schema;
}

}  // namespace

ordered_json claims_properties() {
  return {{"expect",
           list_of(expectation_schema(),
                   "What a source claims, and the band in which ours must lie; decides no trial.")},
          {"quoted", list_of(object_of(quoted_table().docs()),
                             "Rows of other methods, beside which that of this one is printed.")}};
}

}  // namespace croon
