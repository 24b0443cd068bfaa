#include "test/contract/every_parameter.hpp"

#include <nlohmann/json.hpp>

#include "test/contract/every_stage.hpp"

namespace croon::test {
namespace {

using nlohmann::json;
using params::ParameterDoc;
using params::ParameterType;

void add_parameters(const std::string& stage, const std::string& object,
                    const std::vector<ParameterDoc>& parameters, std::vector<ParameterPlace>& all) {
  for (const ParameterDoc& parameter : parameters) {
    const ParameterPlace here{stage, object, &parameter};
    all.push_back(here);
    if (parameter.members.empty()) continue;
    const json members = minimal_object(parameter.members);
    const bool is_map = parameter.type == ParameterType::map;
    const json value = is_map ? json{{kAnyName, members}} : members;
    const std::string below = here.place() + (is_map ? std::string("/") + kAnyName : "");
    add_parameters(here.with(value).dump(), below, parameter.members, all);
  }
}

}  // namespace

json ParameterPlace::with(const json& value) const {
  json changed = json::parse(stage);
  changed[json::json_pointer(place())] = value;
  return changed;
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
