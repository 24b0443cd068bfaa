#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/params/choice.hpp"
#include "registry/help_parts.hpp"

namespace croon {
namespace {

using nlohmann::ordered_json;
using params::ParameterDoc;
using params::ParameterType;

const params::Words<ParameterType> kTypeNames = {
    {"boolean", ParameterType::boolean},   {"integer", ParameterType::integer},
    {"number", ParameterType::number},     {"text", ParameterType::text},
    {"choice", ParameterType::choice},     {"numbers", ParameterType::numbers},
    {"choices", ParameterType::choices},   {"stage", ParameterType::stage},
    {"stages", ParameterType::stages},     {"group", ParameterType::group},
    {"map", ParameterType::map},           {"interval", ParameterType::interval},
    {"per_axis", ParameterType::per_axis}, {"texts", ParameterType::texts},
    {"list", ParameterType::list},         {"json", ParameterType::json}};

ordered_json parameters_json(const std::vector<ParameterDoc>& parameters);

ordered_json parameter_json(const ParameterDoc& parameter) {
  ordered_json value = {{"key", parameter.key},
                        {"type", params::word_of(kTypeNames, parameter.type)}};
  if (std::isfinite(parameter.range.minimum)) value["minimum"] = parameter.range.minimum;
  if (std::isfinite(parameter.range.maximum)) value["maximum"] = parameter.range.maximum;
  if (!parameter.choices.empty()) value["choices"] = parameter.choices;
  if (!parameter.stage_kind.empty()) value["kind"] = parameter.stage_kind;
  if (!parameter.name_words.empty()) value["names"] = parameter.name_words;
  value["required"] = parameter.is_required;
  if (!parameter.is_required && !parameter.is_optional) {
    value["default"] = ordered_json::parse(parameter.default_json);
  }
  value["sentence"] = parameter.sentence;
  if (!parameter.members.empty()) value["members"] = parameters_json(parameter.members);
  return value;
}

ordered_json parameters_json(const std::vector<ParameterDoc>& parameters) {
  ordered_json list = ordered_json::array();
  for (const ParameterDoc& parameter : parameters) list.push_back(parameter_json(parameter));
  return list;
}

ordered_json extras_json(const std::vector<params::ExtraDoc>& extras) {
  ordered_json list = ordered_json::array();
  for (const params::ExtraDoc& extra : extras) {
    list.push_back({{"extra", extra.name}, {"sentence", extra.meaning}});
  }
  return list;
}

ordered_json channels_json(const std::set<std::string>& channels) {
  ordered_json list = ordered_json::array();
  for (const std::string& channel : channels) list.push_back({{"channel", channel}});
  return list;
}

/// The channels and the extras that a stage needs.
ordered_json needs_json(const params::DataFlow& flow) {
  std::set<std::string> channels = flow.target_channels;
  channels.insert(flow.source_channels.begin(), flow.source_channels.end());
  ordered_json list = channels_json(channels);
  for (const ordered_json& extra : extras_json(flow.takes)) list.push_back(extra);
  return list;
}

}  // namespace

std::string json_list(const StageList& stages) {
  ordered_json list = ordered_json::array();
  for (const StageEntry* stage : stages) {
    list.push_back({{"kind", stage->kind},
                    {"name", stage->name},
                    {"version", stage->version},
                    {"summary", stage->summary},
                    {"source", stage->source},
                    {"needs", needs_json(stage->flow)},
                    {"reads", channels_json(stage->flow.optional_channels)},
                    {"provides", extras_json(stage->flow.gives)},
                    {"parameters", parameters_json(stage->parameters)}});
  }
  return list.dump(2) + "\n";
}

}  // namespace croon
