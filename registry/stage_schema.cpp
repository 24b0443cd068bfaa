#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

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
  for (const ParameterDoc& parameter : entry.parameters) {
    properties[parameter.key] = parameter_schema(parameter);
    if (parameter.is_required) required.push_back(parameter.key);
  }
  return {{"type", "object"},
          {"description", entry.summary + " Source: " + entry.source + "."},
          {"properties", properties},
          {"required", required},
          {"additionalProperties", false}};
}

}  // namespace croon
