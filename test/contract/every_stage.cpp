#include "test/contract/every_stage.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "registry/registry.hpp"

namespace croon::test {

namespace {

using params::ParameterDoc;
using params::ParameterType;

/// A value that the required parameter takes.
nlohmann::ordered_json any_value(const ParameterDoc& parameter) {
  switch (parameter.type) {
    case ParameterType::text:
      return "some_words";
    case ParameterType::group:
      if (!parameter.choices.empty()) return parameter.choices.front();
      return minimal_object(parameter.members);
    case ParameterType::map:
      return {{kAnyName, minimal_object(parameter.members)}};
    default:
      throw std::logic_error("no value for the required key " + parameter.key);
  }
}

}  // namespace

nlohmann::ordered_json minimal_object(const std::vector<ParameterDoc>& parameters) {
  nlohmann::ordered_json value = nlohmann::ordered_json::object();
  for (const ParameterDoc& parameter : parameters) {
    if (parameter.is_required) value[parameter.key] = any_value(parameter);
  }
  return value;
}

std::string minimal_json(const StageEntry& entry) {
  nlohmann::ordered_json value = {{name_key(entry.kind), entry.name}};
  value.update(minimal_object(entry.parameters));
  return value.dump();
}

std::vector<StageCase> every_stage(const std::vector<std::string>& left_out) {
  std::vector<StageCase> stages;
  for (const StageEntry& entry : registry().entries()) {
    if (std::find(left_out.begin(), left_out.end(), entry.kind) == left_out.end()) {
      stages.emplace_back(entry);
    }
  }
  return stages;
}

std::vector<StageCase> every_stage_of(const std::string& kind) {
  std::vector<StageCase> stages;
  for (const StageEntry& entry : registry().entries()) {
    if (entry.kind == kind) stages.emplace_back(entry);
  }
  return stages;
}

std::string stage_case_name(const testing::TestParamInfo<StageCase>& info) {
  return info.param.get().kind + "_" + info.param.get().name;
}

}  // namespace croon::test
