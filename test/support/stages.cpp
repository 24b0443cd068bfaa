#include "test/support/stages.hpp"

#include <nlohmann/json.hpp>

namespace croon::test {

params::BuiltStage build_stage(const std::string& kind, const std::string& json) {
  const nlohmann::json value = params::parse_json(json, "test");
  std::vector<Fault> faults;
  const params::BuiltStage built = registry().build(kind, params::Node(value, "test", faults));
  if (!faults.empty()) throw InputError(faults);
  return built;
}

}  // namespace croon::test
