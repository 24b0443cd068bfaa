#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/params/group.hpp"
#include "registry/schema.hpp"

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

/// Adds the parameters to the properties of an object, and the keys of required ones to `required`.
void add_parameters(const std::vector<ParameterDoc>& parameters, ordered_json& properties,
                    ordered_json& required) {
  for (const ParameterDoc& parameter : parameters) {
    properties[parameter.key] = parameter_schema(parameter);
    if (parameter.is_required) required.push_back(parameter.key);
  }
}

ordered_json has_keys(const std::vector<std::string>& keys) { return {{"required", keys}}; }

/// The schema of objects with a key at `path`, such as "sweep/rotation_deg", whose value satisfies
/// the schema `value`.
ordered_json has_path(const std::string& path, const ordered_json& value) {
  const std::size_t slash = path.find('/');
  const std::string key = path.substr(0, slash);
  ordered_json schema = has_keys({key});
  const bool is_last = slash == std::string::npos;
  if (!is_last || !value.empty()) {
    schema["properties"] = {{key, is_last ? value : has_path(path.substr(slash + 1), value)}};
  }
  return schema;
}

/// The schema of objects that satisfy the condition of `rule`.
ordered_json condition_schema(const params::KeyRule& rule) {
  const ordered_json any = ordered_json::object();
  if (rule.words.empty()) {
    const ordered_json has_key = has_path(rule.key, any);
    return rule.is_negated ? ordered_json{{"not", has_key}} : has_key;
  }
  const ordered_json one_of = {{"enum", rule.words}};
  return has_path(rule.key, rule.is_negated ? ordered_json{{"not", one_of}} : one_of);
}

ordered_json rule_schema(const params::KeyRule& rule) {
  if (!rule.one_of.empty()) {
    ordered_json alternatives = ordered_json::array();
    for (const std::string& key : rule.one_of) alternatives.push_back(has_keys({key}));
    return {{"oneOf", alternatives}};
  }
  ordered_json then = ordered_json::object();
  if (!rule.required.empty()) then["required"] = rule.required;
  if (!rule.excluded.empty()) {
    ordered_json excluded = ordered_json::array();
    for (const std::string& key : rule.excluded) excluded.push_back(has_keys({key}));
    then["not"] = {{"anyOf", excluded}};
  }
  return {{"if", condition_schema(rule)}, {"then", then}};
}

/// The schema of the object of a group, or of each object of a map or list.
ordered_json object_schema(const ParameterDoc& parameter) {
  ordered_json schema = croon::object_schema(parameter.members, parameter.rules);
  if (parameter.preset_json.empty()) return schema;
  schema["properties"][params::kLikeKey] = {
      {"enum", parameter.choices}, {"description", "The preset that supplies the other values."}};
  if (schema.contains("required")) {
    // A preset has a value for every key.
    schema["anyOf"] = {has_keys({params::kLikeKey}), {{"required", schema["required"]}}};
    schema.erase("required");
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
          {"propertyNames", {{"pattern", params::kKeyName.pattern()}}},
          {"additionalProperties", object_schema(parameter)},
          {"minProperties", 1}};
}

ordered_json text_schema(const ParameterDoc& parameter) {
  ordered_json schema = {{"type", "string"}};
  if (parameter.name_rule) {
    schema["pattern"] = parameter.name_rule->pattern();
  } else if (!parameter.may_be_empty) {
    schema["minLength"] = 1;
  }
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
    case ParameterType::interval: {
      ordered_json schema = list_schema(number_schema("number", parameter.range));
      schema["minItems"] = schema["maxItems"] = 2;
      return schema;
    }
    case ParameterType::per_axis: {
      const ordered_json number = number_schema("number", parameter.range);
      ordered_json three = list_schema(number);
      three["minItems"] = three["maxItems"] = 3;
      return {{"anyOf", ordered_json::array({number, three})}};
    }
    case ParameterType::text:
      return text_schema(parameter);
    case ParameterType::texts:
      return list_schema({{"type", "string"}});
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
    case ParameterType::list:
      return list_schema(object_schema(parameter));
    case ParameterType::json:
      return definition(parameter.definition);
  }
  throw std::logic_error("a parameter type without a schema");
}

}  // namespace

ordered_json definition(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }

ordered_json parameter_schema(const ParameterDoc& parameter) {
  ordered_json schema = value_schema(parameter);
  schema["description"] = parameter.sentence;
  if (!parameter.is_required && !parameter.is_optional) {
    schema["default"] = ordered_json::parse(parameter.default_json);
  }
  return schema;
}

ordered_json object_schema(const std::vector<ParameterDoc>& members,
                           const std::vector<params::KeyRule>& rules) {
  ordered_json properties = ordered_json::object();
  ordered_json required = ordered_json::array();
  add_parameters(members, properties, required);
  ordered_json schema = {
      {"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  for (const params::KeyRule& rule : rules) schema["allOf"].push_back(rule_schema(rule));
  return schema;
}

namespace {

/// The schema of any stage of `kind`. The enumeration of names lets editors complete a name.
ordered_json kind_schema(const Catalogue& catalogue, const std::string& kind) {
  const std::vector<std::string> names = catalogue.names(kind);
  if (names.empty()) return {{"not", ordered_json::object()}};
  ordered_json one_of = ordered_json::array();
  for (const std::string& name : names) one_of.push_back(definition(kind + "." + name));
  return {{"type", "object"},
          {"properties", {{name_key(kind), {{"enum", names}}}}},
          {"required", ordered_json::array({name_key(kind)})},
          {"oneOf", one_of}};
}

ordered_json stage_schema(const StageEntry& entry) {
  const std::string key = name_key(entry.kind);
  ordered_json properties = {{key, {{"const", entry.name}}}};
  ordered_json required = ordered_json::array({key});
  if (entry.kind == "step") {
    properties["name"] = {
        {"type", "string"},
        {"pattern", params::kKeyName.pattern()},
        {"description", "The name of the step in variants and timings; by default its type."}};
  }
  add_parameters(entry.parameters, properties, required);
  return {{"type", "object"},
          {"description", entry.summary + " Source: " + entry.source + "."},
          {"properties", properties},
          {"required", required},
          {"additionalProperties", false}};
}

/// The kinds to which the schema refers: kinds with stages, the kinds in an experiment's own keys,
/// and the kinds of slots.
std::vector<std::string> referred_kinds(const Catalogue& catalogue) {
  std::vector<std::string> kinds;
  for (const StageKind& kind : catalogue.kinds()) kinds.push_back(kind.name);
  kinds.insert(kinds.end(), {"dataset", "step"});
  for (const StageEntry& entry : catalogue.entries()) {
    for (const params::ParameterDoc& parameter : entry.parameters) {
      if (!parameter.stage_kind.empty()) kinds.push_back(parameter.stage_kind);
    }
  }
  return kinds;
}

}  // namespace

ordered_json stage_definitions(const Catalogue& catalogue) {
  ordered_json all;
  for (const std::string& kind : referred_kinds(catalogue)) {
    all[kind] = kind_schema(catalogue, kind);
  }
  for (const StageEntry& entry : catalogue.entries()) {
    all[entry.kind + "." + entry.name] = stage_schema(entry);
  }
  return all;
}

}  // namespace croon
