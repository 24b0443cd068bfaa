#include "test/contract/every_parameter.hpp"

#include <nlohmann/json.hpp>

#include "test/contract/every_stage.hpp"

namespace croon::test {
namespace {

using nlohmann::json;
using params::ParameterDoc;
using params::ParameterType;

/// An object that the parameter takes: the first preset's, for conditions hold there.
json any_object(const ParameterDoc& parameter) {
  if (!parameter.preset_json.empty()) return json::parse(parameter.preset_json.front());
  if (!parameter.is_required) {
    // An empty map has no object with members.
    const json value = json::parse(parameter.default_json);
    if (parameter.type != ParameterType::map || !value.empty()) return value;
  }
  const json members = minimal_object(parameter.members);
  return parameter.type == ParameterType::map ? json{{kAnyName, members}} : members;
}

void add_parameters(const std::string& stage, const std::string& object,
                    const std::vector<ParameterDoc>& parameters, std::vector<ParameterPlace>& all) {
  for (const ParameterDoc& parameter : parameters) {
    const ParameterPlace here{stage, object, &parameter};
    all.push_back(here);
    if (parameter.members.empty()) continue;
    const json::json_pointer place(here.place());
    json with_object = json::parse(stage);
    if (!with_object.contains(place) || !with_object[place].is_object()) {
      with_object[place] = any_object(parameter);
    }
    const bool is_map = parameter.type == ParameterType::map;
    const std::string name = is_map ? "/" + with_object[place].begin().key() : "";
    add_parameters(with_object.dump(), here.place() + name, parameter.members, all);
  }
}

}  // namespace

json ParameterPlace::with(const json& value) const {
  json changed = json::parse(stage);
  changed[json::json_pointer(place())] = value;
  return changed;
}

bool ParameterPlace::is_in(const std::string& pointer) const {
  if (pointer == "/") return true;
  return object == pointer || object.rfind(pointer + "/", 0) == 0;
}

std::vector<ParameterPlace> every_parameter(const StageEntry& entry) {
  std::vector<ParameterPlace> all;
  add_parameters(minimal_json(entry), "", entry.parameters, all);
  return all;
}

json default_value(const ParameterDoc& parameter) {
  const json value = json::parse(parameter.default_json);
  for (std::size_t i = 0; i < parameter.preset_json.size(); ++i) {
    if (value == parameter.choices[i]) return json::parse(parameter.preset_json[i]);
  }
  return value;
}

}  // namespace croon::test
