// A stage that states its data flow states that of the stages in its slots too: nothing else asks
// them, and what they need would be found missing in the middle of a run.
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "registry/registry.hpp"
#include "test/contract/every_stage.hpp"

namespace croon::test {
namespace {

using nlohmann::json;
using params::ParameterDoc;
using params::ParameterType;

/// Builds the registry's stages, each as if it needed a channel of its own.
class NeedyStages final : public params::StageBuilder {
 public:
  params::BuiltStage build(const std::string& kind, const params::Node& node) const override {
    params::BuiltStage built = registry().build(kind, node);
    const std::string channel = kind + " " + std::to_string(channels_.size());
    channels_.insert(channel);
    built.flow = params::needs_channels({channel});
    return built;
  }
  /// Of all stages that were built.
  const std::set<std::string>& channels() const { return channels_; }

 private:
  mutable std::set<std::string> channels_;
};

/// The stage with its defaults, and with a stage in each list of slots.
json with_full_slots(const StageEntry& entry) {
  json stage = json::parse(minimal_json(entry));
  for (const ParameterDoc& parameter : entry.parameters) {
    if (parameter.type != ParameterType::stages) continue;
    const StageEntry& any = every_stage_of(parameter.stage_kind).front();
    stage[parameter.key] = json::array({json::parse(minimal_json(any))});
  }
  return stage;
}

class ContractOfDataFlow : public EveryStage {};

TEST_P(ContractOfDataFlow, HasWhatTheStagesInSlotsNeed) {
  const json stage = with_full_slots(entry());
  std::vector<Fault> faults;
  NeedyStages slots;
  const params::BuiltStage built =
      entry().build(params::Node(stage, "contract.json", faults), slots);
  ASSERT_TRUE(faults.empty()) << faults.front().line();
  if (!built.flow) return;  // It states none: the catalogue adds up those of its slots.
  for (const std::string& channel : slots.channels()) {
    EXPECT_TRUE(built.flow->target_channels.count(channel) > 0 ||
                built.flow->source_channels.count(channel) > 0)
        << "the stage in the slot of the kind and with the number \"" << channel << "\"";
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfDataFlow, testing::ValuesIn(every_stage()),
                         stage_case_name);

}  // namespace
}  // namespace croon::test
