#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/params/group.hpp"
#include "framework/params/values.hpp"
#include "registry/schema_parts.hpp"

namespace croon {
namespace {

using nlohmann::ordered_json;
using params::ParameterDoc;
using params::ParameterType;

/// A number without the ".0" that whole doubles get.
ordered_json plain(double value) { return ordered_json::parse(params::value_json(value)); }

ordered_json number_schema(const char* type, const params::Range& range) {
  ordered_json schema = {{"type", type}};
  if (std::isfinite(range.minimum)) schema["minimum"] = plain(range.minimum);
  if (std::isfinite(range.maximum)) schema["maximum"] = plain(range.maximum);
  return schema;
}

ordered_json list_schema(const ordered_json& items) {
  return {{"type", "array"}, {"items", items}};
}

ordered_json filled_list_schema(const ordered_json& items) {
  ordered_json schema = list_schema(items);
  schema["minItems"] = 1;
  return schema;
}

ordered_json word_list_schema(const std::vector<std::string>& words) {
  ordered_json schema = filled_list_schema({{"enum", words}});
  schema["uniqueItems"] = true;
  return schema;
}

/// Puts the parameters among the properties of an object, and their keys among the required ones.
void add_parameters(const std::vector<ParameterDoc>& parameters, ordered_json& properties,
                    ordered_json& required) {
  for (const ParameterDoc& parameter : parameters) {
    properties[parameter.key] = parameter_schema(parameter);
    if (parameter.is_required) required.push_back(parameter.key);
  }
}

/// The object of a group, or each object of a map.
ordered_json object_schema(const ParameterDoc& parameter) {
  ordered_json properties = ordered_json::object();
  if (!parameter.choices.empty()) {
    properties[params::kLikeKey] = {{"enum", parameter.choices},
                                    {"description", "The preset to begin with."}};
  }
  ordered_json required = ordered_json::array();
  add_parameters(parameter.members, properties, required);
  ordered_json schema = {
      {"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (required.empty()) return schema;
  if (parameter.choices.empty()) {
    schema["required"] = required;
  } else {
    // A preset has a value for every key.
    const ordered_json like = {{"required", ordered_json::array({params::kLikeKey})}};
    schema["anyOf"] = ordered_json::array({like, {{"required", required}}});
  }
  return schema;
}

ordered_json group_schema(const ParameterDoc& parameter) {
  const ordered_json object = object_schema(parameter);
  if (parameter.choices.empty()) return object;
  return {{"anyOf", ordered_json::array({{{"enum", parameter.choices}}, object})}};
}

ordered_json map_schema(const ParameterDoc& parameter) {
  return {{"type", "object"},
          {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]+$"}}},
          {"additionalProperties", object_schema(parameter)},
          {"minProperties", 1}};
}

ordered_json value_schema(const ParameterDoc& parameter) {
  switch (parameter.type) {
    case ParameterType::boolean:
      return {{"type", "boolean"}};
    case ParameterType::integer:
      return number_schema("integer", parameter.range);
    case ParameterType::number:
      return number_schema("number", parameter.range);
    case ParameterType::text:
      return {{"type", "string"}, {"minLength", 1}};
    case ParameterType::choice:
      return {{"enum", parameter.choices}};
    case ParameterType::numbers:
      return filled_list_schema(number_schema("number", parameter.range));
    case ParameterType::choices:
      return word_list_schema(parameter.choices);
    case ParameterType::stage:
      return definition(parameter.stage_kind);
    case ParameterType::stages:
      return list_schema(definition(parameter.stage_kind));
    case ParameterType::group:
      return group_schema(parameter);
    case ParameterType::map:
      return map_schema(parameter);
  }
  throw std::logic_error("a parameter type without a schema");
}

}  // namespace

ordered_json definition(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }

ordered_json parameter_schema(const ParameterDoc& parameter) {
  ordered_json schema = value_schema(parameter);
  schema["description"] = parameter.sentence;
  if (!parameter.is_required) schema["default"] = ordered_json::parse(parameter.default_json);
  return schema;
}

ordered_json stage_schema(const StageEntry& entry) {
  const std::string key = name_key(entry.kind);
  ordered_json properties = {{key, {{"const", entry.name}}}};
  ordered_json required = ordered_json::array({key});
  if (entry.kind == "step") {
    properties["name"] = {
        {"type", "string"},
        {"pattern", "^[A-Za-z0-9_-]+$"},
        {"description", "What variants and timings call the step; else its kind."}};
  }
  add_parameters(entry.parameters, properties, required);
  return {{"type", "object"},
          {"description", entry.summary + " Source: " + entry.source + "."},
          {"properties", properties},
          {"required", required},
          {"additionalProperties", false}};
}

}  // namespace croon
