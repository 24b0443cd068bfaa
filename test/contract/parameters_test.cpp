// Every stage reads its parameters as its table says, and says where in the file they are wrong.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "registry/registry.hpp"
#include "test/contract/every_stage.hpp"
#include "test/support/stages.hpp"

namespace croon::test {
namespace {

using nlohmann::json;
using params::ParameterDoc;
using params::ParameterType;

class ContractOfParameters : public EveryStage {
 protected:
  json minimal() const { return json::parse(minimal_json(entry())); }

  std::vector<Fault> faults_of(const json& value) const {
    std::vector<Fault> faults;
    registry().build(entry().kind, params::Node(value, "contract.json", faults));
    return faults;
  }

  /// Expects a fault at `pointer` where the stage's `key` is `value`.
  void expect_fault(const std::string& key, const json& value, const std::string& pointer) const {
    json stage = minimal();
    stage[key] = value;
    const std::vector<Fault> faults = faults_of(stage);
    const bool is_found = std::any_of(faults.begin(), faults.end(), [&](const Fault& fault) {
      return fault.file == "contract.json" && fault.where == pointer && !fault.message.empty();
    });
    EXPECT_TRUE(is_found) << stage << " gave " << faults.size() << " faults, none at " << pointer;
  }

  /// Expects that the value just outside of each finite end of the range is a fault, and the end is
  /// none.
  void expect_range(const ParameterDoc& parameter, double step, bool is_list) const {
    const auto wrapped = [&](double value) { return is_list ? json::array({value}) : json(value); };
    const std::string pointer = "/" + parameter.key + (is_list ? "/0" : "");
    for (const double sign : {-1.0, 1.0}) {
      const double end = sign < 0 ? parameter.range.minimum : parameter.range.maximum;
      if (!std::isfinite(end)) continue;
      const double outside = end + sign * std::max(step, std::abs(end) * 1e-6);
      expect_fault(parameter.key, wrapped(outside), pointer);
      json stage = minimal();
      stage[parameter.key] = wrapped(end);
      // The end of a range may break a condition between parameters, which is a fault of the whole
      // stage.
      for (const Fault& fault : faults_of(stage)) EXPECT_EQ(fault.where, "/") << fault.line();
    }
  }
};

TEST_P(ContractOfParameters, DefaultsValidate) {
  EXPECT_NO_THROW({
    const params::BuiltStage built = build_stage(entry().kind, minimal_json(entry()));
    EXPECT_NE(built.stage, nullptr);
  });
}

TEST_P(ContractOfParameters, ResolvedJsonBuildsTheSame) {
  const params::BuiltStage built = build_stage(entry().kind, minimal_json(entry()));
  EXPECT_EQ(build_stage(entry().kind, built.resolved).resolved, built.resolved);
  const json resolved = json::parse(built.resolved);
  EXPECT_EQ(resolved.size(), entry().parameters.size() + 1);
  for (const ParameterDoc& parameter : entry().parameters) {
    ASSERT_TRUE(resolved.contains(parameter.key)) << parameter.key;
    const bool is_slot = parameter.type == ParameterType::stage;
    if (parameter.is_required || is_slot) continue;
    EXPECT_EQ(resolved[parameter.key], json::parse(parameter.default_json)) << parameter.key;
  }
}

TEST_P(ContractOfParameters, DocumentedWhole) {
  EXPECT_EQ(entry().summary.back(), '.');
  EXPECT_FALSE(entry().source.empty());
  EXPECT_NE(entry().source.back(), '.');
  for (const ParameterDoc& parameter : entry().parameters) {
    ASSERT_FALSE(parameter.sentence.empty()) << parameter.key;
    EXPECT_EQ(parameter.sentence.back(), '.') << parameter.key;
  }
}

TEST_P(ContractOfParameters, UnknownKeyIsAFault) {
  expect_fault("no_such_parameter", 1, "/no_such_parameter");
}

TEST_P(ContractOfParameters, WrongTypeIsAFault) {
  for (const ParameterDoc& parameter : entry().parameters) {
    const std::string pointer = "/" + parameter.key;
    expect_fault(parameter.key, nullptr, pointer);
    const bool takes_object = parameter.type == ParameterType::stage;
    expect_fault(parameter.key, takes_object ? json("word") : json::object(), pointer);
    const bool takes_words =
        parameter.type == ParameterType::text || parameter.type == ParameterType::choice;
    expect_fault(parameter.key, takes_words ? json(1.5) : json("no such word"), pointer);
  }
}

TEST_P(ContractOfParameters, OutOfRangeIsAFault) {
  for (const ParameterDoc& parameter : entry().parameters) {
    if (parameter.type == ParameterType::integer) expect_range(parameter, 1.0, false);
    if (parameter.type == ParameterType::number) expect_range(parameter, 1e-9, false);
    if (parameter.type == ParameterType::numbers) expect_range(parameter, 1e-9, true);
  }
}

TEST_P(ContractOfParameters, WordsThatAreNoneAndEmptyListsAreFaults) {
  for (const ParameterDoc& parameter : entry().parameters) {
    const std::string pointer = "/" + parameter.key;
    if (parameter.type == ParameterType::text) expect_fault(parameter.key, "", pointer);
    if (parameter.type == ParameterType::choice)
      expect_fault(parameter.key, "none of them", pointer);
    if (parameter.type == ParameterType::numbers || parameter.type == ParameterType::choices) {
      expect_fault(parameter.key, json::array(), pointer);
    }
    if (parameter.type == ParameterType::choices) {
      const std::string word = parameter.choices.front();
      expect_fault(parameter.key, {word, word}, pointer + "/1");
    }
  }
}

TEST_P(ContractOfParameters, UnknownStageInASlotIsAFault) {
  for (const ParameterDoc& parameter : entry().parameters) {
    const std::string key = name_key(parameter.stage_kind);
    const json no_such_stage = {{key, "no_such_stage"}};
    if (parameter.type == ParameterType::stage) {
      expect_fault(parameter.key, no_such_stage, "/" + parameter.key + "/" + key);
    }
    if (parameter.type == ParameterType::stages) {
      expect_fault(parameter.key, json::array({no_such_stage}), "/" + parameter.key + "/0/" + key);
    }
  }
}

TEST_P(ContractOfParameters, MissingKeyIsAFault) {
  for (const ParameterDoc& parameter : entry().parameters) {
    if (!parameter.is_required) continue;
    json stage = minimal();
    stage.erase(parameter.key);
    EXPECT_FALSE(faults_of(stage).empty()) << parameter.key;
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfParameters, testing::ValuesIn(every_stage()),
                         stage_case_name);

}  // namespace
}  // namespace croon::test
