#include <map>
#include <nlohmann/json.hpp>

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

ordered_json starts_schema() {
  return object_of("How starts are drawn: a pose (R, t) moved to (R_d R, t + d).",
                   {{"around",
                     ParameterType::choice,
                     R"("truth")",
                     {},
                     {"truth", "nominal", "initial"},
                     "",
                     "The pose that starts are drawn around."},
                    {"rotation_deg",
                     ParameterType::number,
                     "45",
                     {0, 180},
                     {},
                     "",
                     "Half range of roll, pitch and yaw; 180 is any rotation, uniform on SO(3)."},
                    {"translation_m",
                     ParameterType::number,
                     "0.1",
                     {0, 1e6},
                     {},
                     "",
                     "Half range of x, y and z in reference axes."},
                    {"trials",
                     ParameterType::integer,
                     "50",
                     {1, 1e6},
                     {},
                     "",
                     "Starts per variant, scene and sensor."}});
}

ordered_json success_schema() {
  return object_of("How near the truth a trial must end to count as a success.",
                   {{"rotation_deg",
                     ParameterType::number,
                     "0.5",
                     {0, 180},
                     {},
                     "",
                     "Largest angle between the estimate and the truth."},
                    {"translation_m",
                     ParameterType::number,
                     "0.1",
                     {0, 1e6},
                     {},
                     "",
                     "Largest distance between the estimate and the truth."}});
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
  return {
      {"name", name_schema("^[A-Za-z0-9_-][A-Za-z0-9_.-]*$",
                           "The experiment's name; its results go to results/NAME.")},
      {"description", {{"type", "string"}, {"description", "The question it answers."}}},
      {"dataset", definition("dataset")},
      {"starts", starts_schema()},
      {"seed", parameter_schema(seed())},
      {"success", success_schema()},
      {"pipeline", pipeline},
      {"variants", list_of(variant_schema(catalogue), "Other pipelines, told by what differs.")},
      {"grid",
       places_schema(catalogue, true,
                     "The product of these lists, on the base pipeline and each variant.")}};
}

}  // namespace croon
