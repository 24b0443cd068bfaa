#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "registry/experiment_keys.hpp"
#include "registry/schema_parts.hpp"

namespace croon {
namespace {

using nlohmann::ordered_json;
using params::ParameterDoc;
using params::ParameterType;

ordered_json object_schema(const std::string& description, const ordered_json& properties) {
  return {{"type", "object"},
          {"description", description},
          {"properties", properties},
          {"additionalProperties", false}};
}

ordered_json list_of(const ordered_json& items, const std::string& description) {
  return {{"type", "array"}, {"description", description}, {"items", items}};
}

ordered_json name_schema(const std::string& pattern, const std::string& description) {
  return {{"type", "string"}, {"pattern", pattern}, {"description", description}};
}

/// The object whose keys are `parameters`.
ordered_json object_of(const std::string& description,
                       const std::vector<ParameterDoc>& parameters) {
  ordered_json properties;
  for (const ParameterDoc& parameter : parameters) {
    properties[parameter.key] = parameter_schema(parameter);
  }
  return object_schema(description, properties);
}

/// No object has both keys at once.
ordered_json not_both(const ordered_json& a, const ordered_json& b) {
  return {{"not", {{"allOf", ordered_json::array({a, b})}}}};
}

ordered_json has_key(const std::string& key) { return {{"required", ordered_json::array({key})}}; }

/// An object whose "sweep" is one of `key`.
ordered_json sweeps(const std::string& key) {
  ordered_json schema = has_key("sweep");
  schema["properties"] = {{"sweep", has_key(key)}};
  return schema;
}

ordered_json sweep_schema() {
  ordered_json schema =
      object_of("A ramp of the size of the perturbation, to measure how far a method finds home.",
                sweep_table().docs());
  const std::array<std::string, 2> ranges = {"rotation_deg", "translation_m"};
  schema["oneOf"] = ordered_json::array();
  for (const std::string& range : ranges) {
    ordered_json& ends = schema["properties"][range];
    ends["minItems"] = ends["maxItems"] = 2;
    ends.erase("default");
    schema["oneOf"].push_back(has_key(range));
  }
  return schema;
}

ordered_json starts_schema() {
  ordered_json schema =
      object_of("How starts are drawn: a pose (R, t) moved to (R_d R, t + d); or a file of them.",
                start_table().docs());
  schema["allOf"] = ordered_json::array();
  for (const char* key : {"around", "rotation_deg", "translation_m", "sweep"}) {
    schema["allOf"].push_back(not_both(has_key("file"), has_key(key)));
  }
  for (const char* key : {"rotation_deg", "translation_m"}) {
    schema["allOf"].push_back(not_both(sweeps(key), has_key(key)));
  }
  schema["properties"]["sweep"] = sweep_schema();
  schema["properties"]["file"] = {
      {"type", "string"},
      {"minLength", 1},
      {"description",
       "A file of starts, as croon starts writes it: below the data root, else beside the "
       "experiment."}};
  return schema;
}

ordered_json success_schema() {
  return object_of("How near the truth a trial must end to count as a success.",
                   success_table().docs());
}

/// 2^53, the largest seed that is exact in every JSON reader.
ParameterDoc seed() {
  return {"seed",
          ParameterType::integer,
          "1",
          {0, 9007199254740992.0},
          {},
          "",
          "Every start is drawn from (seed, scene, sensor, trial)."};
}

/// What stands at a place of the pipeline whose path ends in a parameter's key: that parameter of
/// any stage.
std::map<std::string, ordered_json> values_by_key(const Catalogue& catalogue) {
  std::map<std::string, ordered_json> values;
  for (const StageEntry& entry : catalogue.entries()) {
    if (entry.kind == "dataset") continue;
    for (const ParameterDoc& parameter : entry.parameters) {
      values[parameter.key]["anyOf"].push_back(
          definition(entry.kind + "." + entry.name + "/properties/" + parameter.key));
    }
  }
  return values;
}

/// An object whose keys are places of a pipeline: "STEP", "STEP.KEY" or "STEP.KEY.KEY". `is_grid`:
/// its values are lists of what may stand there.
ordered_json places_schema(const Catalogue& catalogue, bool is_grid,
                           const std::string& description) {
  const auto value = [is_grid](const ordered_json& one) -> ordered_json {
    if (!is_grid) return one;
    return {{"type", "array"}, {"items", one}, {"minItems", 1}};
  };
  ordered_json patterns = {{"^[^.]+$", value(definition("step"))}};
  for (const auto& [key, any_of] : values_by_key(catalogue)) {
    patterns["\\." + key + "$"] = value(any_of);
  }
  return {{"type", "object"},
          {"description", description},
          {"patternProperties", patterns},
          {"additionalProperties", false}};
}

ordered_json variant_schema(const Catalogue& catalogue) {
  ordered_json schema = object_schema(
      "The base pipeline with some of its slots replaced and some of its steps removed.",
      {{"name", name_schema(R"(^[A-Za-z0-9_+=()-]([A-Za-z0-9_.+=() -]*[A-Za-z0-9_.+=()-])?$)",
                            "What the variant is called; \"base\" is the base pipeline.")},
       {"replace",
        places_schema(catalogue, false, "STEP or STEP.SLOT and what stands there instead.")},
       {"remove", list_of({{"type", "string"}}, "The names of steps that are left out.")}});
  schema["required"] = {"name"};
  return schema;
}

}  // namespace

ordered_json experiment_properties(const Catalogue& catalogue) {
  ordered_json pipeline = list_of(definition("step"), "The steps of the method, in order.");
  pipeline["minItems"] = 1;
  ordered_json properties = {
      {"name", name_schema("^[A-Za-z0-9_-][A-Za-z0-9_.-]*$",
                           "The experiment's name; its results go to results/NAME.")},
      {"description", {{"type", "string"}, {"description", "The question it answers."}}},
      {"dataset", definition("dataset")},
      {"starts", starts_schema()},
      {"seed", parameter_schema(seed())},
      {"success", success_schema()},
      {"loops",
       {{"type", "boolean"},
        {"description",
         "Each two sensors of a scene are calibrated to each other too, which tells how far the "
         "loop over the reference is from closing."},
        {"default", false}}},
      {"pipeline", pipeline},
      {"variants", list_of(variant_schema(catalogue), "Other pipelines, told by what differs.")},
      {"grid",
       places_schema(catalogue, true,
                     "The product of these lists, on the base pipeline and each variant.")}};
  properties.update(claims_properties());
  return properties;
}

}  // namespace croon
