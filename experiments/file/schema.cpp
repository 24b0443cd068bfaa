#include <map>
#include <nlohmann/json.hpp>

#include "experiments/file/experiment_keys.hpp"
#include "registry/schema.hpp"

namespace croon::experiments {
namespace {

using nlohmann::ordered_json;

/// The possible replacements for a value at a path of the pipeline, by the last key of the path:
/// the parameter of that name in any stage.
std::map<std::string, ordered_json> values_by_key(const Catalogue& catalogue) {
  std::map<std::string, ordered_json> values;
  for (const StageEntry& entry : catalogue.entries()) {
    if (entry.kind == Dataset::kKind) continue;
    for (const params::ParameterDoc& parameter : entry.parameters) {
      values[parameter.key]["anyOf"].push_back(
          definition(entry.kind + "." + entry.name + "/properties/" + parameter.key));
    }
  }
  return values;
}

ordered_json list_of(const ordered_json& items) {
  return {{"type", "array"}, {"items", items}, {"minItems", 1}};
}

/// An object whose keys are paths of a pipeline: "STEP", "STEP.KEY" or "STEP.KEY.KEY". If
/// `are_lists`, its values are lists of possible values.
ordered_json paths_schema(const Catalogue& catalogue, bool are_lists) {
  const auto value = [are_lists](const ordered_json& one) {
    return are_lists ? list_of(one) : one;
  };
  ordered_json patterns = {{"^[^.]+$", value(definition(kStepDefinition))}};
  for (const auto& [key, any_of] : values_by_key(catalogue)) {
    patterns["\\." + key + "$"] = value(any_of);
  }
  return {{"type", "object"}, {"patternProperties", patterns}, {"additionalProperties", false}};
}

/// The required keys, unless the file extends another that may have them.
ordered_json required_unless_extended(const ordered_json& required) {
  return {{{"required", {"extends"}}}, {{"required", required}}};
}

}  // namespace

std::string experiment_schema(const Catalogue& catalogue) {
  ordered_json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                         {"title", "An experiment of croon"}};
  schema.update(object_schema(experiment_table().docs(), experiment_table().rules()));
  schema["anyOf"] = required_unless_extended(schema["required"]);
  schema.erase("required");
  schema["$defs"] = stage_definitions(catalogue);
  const ordered_json path = {{"type", "string"}, {"minLength", 1}};
  schema["$defs"][kExtendsDefinition] = {{"anyOf", ordered_json::array({path, list_of(path)})}};
  schema["$defs"][kPipelineDefinition] = list_of(definition(kStepDefinition));
  schema["$defs"][kReplacementsDefinition] = paths_schema(catalogue, false);
  schema["$defs"][kGridDefinition] = paths_schema(catalogue, true);
  return schema.dump(2) + "\n";
}

}  // namespace croon::experiments
