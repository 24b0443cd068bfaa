#include "test/contract/every_stage.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "registry/registry.hpp"

namespace croon::test {

std::string minimal_json(const StageEntry& entry) {
  nlohmann::ordered_json value = {{name_key(entry.kind), entry.name}};
  for (const params::ParameterDoc& parameter : entry.parameters) {
    if (!parameter.is_required) continue;
    if (parameter.type != params::ParameterType::text) {
      throw std::logic_error("no value for the required key " + parameter.key);
    }
    value[parameter.key] = "some/words";
  }
  return value.dump();
}

std::vector<StageEntry> every_stage(const std::vector<std::string>& left_out) {
  std::vector<StageEntry> stages;
  for (const StageEntry& entry : registry().entries()) {
    if (std::find(left_out.begin(), left_out.end(), entry.kind) == left_out.end()) {
      stages.push_back(entry);
    }
  }
  return stages;
}

std::vector<StageEntry> every_stage_of(const std::string& kind) {
  std::vector<StageEntry> stages;
  for (const StageEntry& entry : registry().entries()) {
    if (entry.kind == kind) stages.push_back(entry);
  }
  return stages;
}

std::string stage_case_name(const testing::TestParamInfo<StageEntry>& info) {
  return info.param.kind + "_" + info.param.name;
}

}  // namespace croon::test
