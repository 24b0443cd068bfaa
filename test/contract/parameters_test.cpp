// Every stage reads its parameters as its table says, those of the objects in it too, and says
// where in the file they are wrong.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/params/group.hpp"
#include "registry/registry.hpp"
#include "test/contract/every_parameter.hpp"
#include "test/contract/every_stage.hpp"
#include "test/support/nested_stage.hpp"

namespace croon::test {
namespace {

using nlohmann::json;
using params::ParameterDoc;
using params::ParameterType;

class ContractOfParameters : public EveryStage {
 protected:
  json minimal() const { return json::parse(minimal_json(entry())); }

  params::BuiltStage build(const json& value, std::vector<Fault>& faults) const {
    return entry().build(params::Node(value, "contract.json", faults), registry());
  }

  std::vector<Fault> faults_of(const json& value) const {
    std::vector<Fault> faults;
    build(value, faults);
    return faults;
  }

  /// The resolved JSON of the stage, which must have no faults.
  std::string resolved(const json& value) const {
    std::vector<Fault> faults;
    const params::BuiltStage built = build(value, faults);
    EXPECT_TRUE(faults.empty()) << value << ": " << faults.front().line();
    return built.resolved;
  }

  /// Expects a fault at `pointer` of `stage`.
  void expect_fault(const json& stage, const std::string& pointer) const {
    const std::vector<Fault> faults = faults_of(stage);
    const bool is_found = std::any_of(faults.begin(), faults.end(), [&](const Fault& fault) {
      return fault.file == "contract.json" && fault.where == pointer && !fault.message.empty();
    });
    EXPECT_TRUE(is_found) << stage << " gave " << faults.size() << " faults, none at " << pointer;
  }

  /// Expects a fault, where the parameter is `value`, at the value or at `below` in it.
  void expect_fault(const ParameterPlace& placed, const json& value,
                    const std::string& below = "") const {
    expect_fault(placed.with(value), placed.place() + below);
  }

  /// Expects that the value just outside of each finite end of the range is a fault, and the end is
  /// none.
  void expect_range(const ParameterPlace& placed, double step, bool is_list) const {
    const auto wrapped = [&](double value) { return is_list ? json::array({value}) : json(value); };
    const params::Range& range = placed.parameter->range;
    for (const double sign : {-1.0, 1.0}) {
      const double end = sign < 0 ? range.minimum : range.maximum;
      if (!std::isfinite(end)) continue;
      const double outside = end + sign * std::max(step, std::abs(end) * 1e-6);
      expect_fault(placed, wrapped(outside), is_list ? "/0" : "");
      // The end of a range may break a condition between parameters, which is a fault of the
      // object that has them, or of one around it.
      for (const Fault& fault : faults_of(placed.with(wrapped(end)))) {
        EXPECT_TRUE(placed.is_in(fault.where)) << fault.line();
      }
    }
  }
};

TEST_P(ContractOfParameters, DefaultsValidate) {
  std::vector<Fault> faults;
  EXPECT_NE(build(minimal(), faults).stage, nullptr);
  EXPECT_TRUE(faults.empty()) << faults.front().line();
}

TEST_P(ContractOfParameters, ResolvedJsonBuildsTheSame) {
  const std::string text = resolved(minimal());
  const json stage = json::parse(text);
  EXPECT_EQ(resolved(stage), text);
  std::size_t keys = 1;
  for (const ParameterDoc& parameter : entry().parameters) keys += parameter.is_optional ? 0 : 1;
  EXPECT_EQ(stage.size(), keys);
  for (const ParameterDoc& parameter : entry().parameters) {
    if (parameter.is_optional) continue;
    ASSERT_TRUE(stage.contains(parameter.key)) << parameter.key;
    const bool is_slot =
        parameter.type == ParameterType::stage || parameter.type == ParameterType::stages;
    if (parameter.is_required || is_slot) continue;
    EXPECT_EQ(stage[parameter.key], default_value(parameter)) << parameter.key;
  }
}

TEST_P(ContractOfParameters, PresetsStandForTheirObjects) {
  for (const ParameterPlace& placed : every_parameter(entry())) {
    if (placed.parameter->type != ParameterType::group) continue;
    for (std::size_t i = 0; i < placed.parameter->choices.size(); ++i) {
      const std::string& name = placed.parameter->choices[i];
      const json object = json::parse(placed.parameter->preset_json[i]);
      for (const json& value : {json(name), json{{params::kLikeKey, name}}, object}) {
        const json stage = json::parse(resolved(placed.with(value)));
        EXPECT_EQ(stage.at(json::json_pointer(placed.place())), object) << value;
      }
    }
  }
}

TEST_P(ContractOfParameters, DocumentedWhole) {
  EXPECT_EQ(entry().summary.back(), '.');
  EXPECT_FALSE(entry().source.empty());
  EXPECT_NE(entry().source.back(), '.');
  for (const ParameterPlace& placed : every_parameter(entry())) {
    ASSERT_FALSE(placed.parameter->sentence.empty()) << placed.place();
    EXPECT_EQ(placed.parameter->sentence.back(), '.') << placed.place();
    EXPECT_NE(placed.parameter->key, params::kLikeKey) << placed.place();
  }
}

TEST_P(ContractOfParameters, UnknownKeyIsAFault) {
  json stage = minimal();
  stage["no_such_parameter"] = 1;
  expect_fault(stage, "/no_such_parameter");
  for (const ParameterPlace& placed : every_parameter(entry())) {
    if (placed.parameter->type != ParameterType::group) continue;
    expect_fault(placed, {{"no_such_parameter", 1}}, "/no_such_parameter");
    expect_fault(placed, {{params::kLikeKey, "no such word"}}, "/like");
  }
}

TEST_P(ContractOfParameters, WrongTypeIsAFault) {
  for (const ParameterPlace& placed : every_parameter(entry())) {
    const ParameterType type = placed.parameter->type;
    expect_fault(placed, nullptr);
    const bool takes_object = type == ParameterType::stage || type == ParameterType::group;
    // A map's object is not empty.
    expect_fault(placed, takes_object ? json("no such word") : json::object());
    const bool takes_words = type == ParameterType::text || type == ParameterType::choice ||
                             type == ParameterType::group;
    expect_fault(placed, takes_words ? json(1.5) : json("no such word"));
  }
}

TEST_P(ContractOfParameters, OutOfRangeIsAFault) {
  for (const ParameterPlace& placed : every_parameter(entry())) {
    const ParameterType type = placed.parameter->type;
    if (type == ParameterType::integer) expect_range(placed, 1.0, false);
    if (type == ParameterType::number) expect_range(placed, 1e-9, false);
    if (type == ParameterType::numbers) expect_range(placed, 1e-9, true);
  }
}

TEST_P(ContractOfParameters, WordsThatAreNoneAndEmptyListsAreFaults) {
  for (const ParameterPlace& placed : every_parameter(entry())) {
    const ParameterType type = placed.parameter->type;
    if (type == ParameterType::text) expect_fault(placed, "");
    if (type == ParameterType::choice) expect_fault(placed, "none of them");
    if (type == ParameterType::numbers || type == ParameterType::choices) {
      expect_fault(placed, json::array());
    }
    if (type == ParameterType::choices) {
      const std::string word = placed.parameter->choices.front();
      expect_fault(placed, {word, word}, "/1");
    }
    if (type == ParameterType::map) {
      expect_fault(placed, {{"a name", json::object()}}, "/a name");
      expect_fault(placed, {{kAnyName, 1}}, std::string("/") + kAnyName);
    }
  }
}

TEST_P(ContractOfParameters, UnknownStageInASlotIsAFault) {
  for (const ParameterPlace& placed : every_parameter(entry())) {
    const std::string key = name_key(placed.parameter->stage_kind);
    const json no_such_stage = {{key, "no_such_stage"}};
    if (placed.parameter->type == ParameterType::stage) {
      expect_fault(placed, no_such_stage, "/" + key);
    }
    if (placed.parameter->type == ParameterType::stages) {
      expect_fault(placed, json::array({no_such_stage}), "/0/" + key);
    }
  }
}

TEST_P(ContractOfParameters, MissingKeyIsAFault) {
  for (const ParameterPlace& placed : every_parameter(entry())) {
    if (!placed.parameter->is_required) continue;
    json stage = json::parse(placed.stage);
    stage[json::json_pointer(placed.object)].erase(placed.parameter->key);
    expect_fault(stage, placed.fault_place());
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfParameters, testing::ValuesIn(every_stage()),
                         stage_case_name);
// A stage with every type of object, because the registry need not have one.
const StageEntry& the_nested_stage() {
  static const StageEntry entry = nested_stage();
  return entry;
}
INSTANTIATE_TEST_SUITE_P(Nested, ContractOfParameters,
                         testing::Values(StageCase(the_nested_stage())), stage_case_name);

}  // namespace
}  // namespace croon::test
