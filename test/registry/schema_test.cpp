#include "registry/schema.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "registry/registry.hpp"
#include "test/support/nested_stage.hpp"

namespace croon {
namespace {

using nlohmann::json;
using params::ParameterDoc;
using params::ParameterType;

json definitions_of(const Catalogue& catalogue) {
  return json::parse(stage_definitions(catalogue).dump());
}

/// The keys of the parameters that must be there.
std::vector<std::string> required_keys(const std::vector<ParameterDoc>& parameters) {
  std::vector<std::string> keys;
  for (const ParameterDoc& parameter : parameters) {
    if (parameter.is_required) keys.push_back(parameter.key);
  }
  return keys;
}

/// Expects the finite ends of the range and no others.
void expect_range(const json& found, const params::Range& range) {
  EXPECT_EQ(found.contains("minimum"), std::isfinite(range.minimum));
  EXPECT_EQ(found.contains("maximum"), std::isfinite(range.maximum));
  if (found.contains("minimum")) {
    EXPECT_EQ(found["minimum"].get<double>(), range.minimum);
  }
  if (found.contains("maximum")) {
    EXPECT_EQ(found["maximum"].get<double>(), range.maximum);
  }
}

void expect_parameters(const json& properties, const std::vector<ParameterDoc>& parameters);

/// Expects the object of a group or a map, and in it what its parameters take.
void expect_object(const json& found, const ParameterDoc& parameter) {
  EXPECT_EQ(found["type"], "object");
  EXPECT_EQ(found["additionalProperties"], false);
  expect_parameters(found["properties"], parameter.members);
  const std::vector<std::string> required = required_keys(parameter.members);
  const bool has_presets = !parameter.choices.empty();
  EXPECT_EQ(found["properties"].size(), parameter.members.size() + (has_presets ? 1 : 0));
  EXPECT_EQ(found.contains("required"), !required.empty() && !has_presets);
  EXPECT_EQ(found.contains("anyOf"), !required.empty() && has_presets);
  if (has_presets) {
    EXPECT_EQ(found["properties"]["like"]["enum"], json(parameter.choices));
  }
}

void expect_group(const json& found, const ParameterDoc& parameter) {
  if (parameter.choices.empty()) return expect_object(found, parameter);
  ASSERT_EQ(found["anyOf"].size(), 2U);
  EXPECT_EQ(found["anyOf"][0]["enum"], json(parameter.choices));
  expect_object(found["anyOf"][1], parameter);
}

void expect_map(const json& found, const ParameterDoc& parameter) {
  EXPECT_EQ(found["minProperties"], 1);
  EXPECT_TRUE(found["propertyNames"].contains("pattern"));
  expect_object(found["additionalProperties"], parameter);
}

void expect_value(const json& found, const ParameterDoc& parameter) {
  const json reference = {{"$ref", "#/$defs/" + parameter.stage_kind}};
  switch (parameter.type) {
    case ParameterType::boolean:
      EXPECT_EQ(found["type"], "boolean");
      break;
    case ParameterType::integer:
      EXPECT_EQ(found["type"], "integer");
      expect_range(found, parameter.range);
      break;
    case ParameterType::number:
      EXPECT_EQ(found["type"], "number");
      expect_range(found, parameter.range);
      break;
    case ParameterType::text:
      EXPECT_EQ(found["type"], "string");
      break;
    case ParameterType::choice:
      EXPECT_EQ(found["enum"], json(parameter.choices));
      break;
    case ParameterType::numbers:
      EXPECT_EQ(found["items"]["type"], "number");
      expect_range(found["items"], parameter.range);
      break;
    case ParameterType::choices:
      EXPECT_EQ(found["items"]["enum"], json(parameter.choices));
      break;
    case ParameterType::stage:
      EXPECT_EQ(found["$ref"], reference["$ref"]);
      break;
    case ParameterType::stages:
      EXPECT_EQ(found["items"], reference);
      break;
    case ParameterType::group:
      expect_group(found, parameter);
      break;
    case ParameterType::map:
      expect_map(found, parameter);
      break;
    case ParameterType::texts:
      EXPECT_EQ(found["items"]["type"], "string");
      break;
    case ParameterType::per_axis:
      expect_range(found["anyOf"][0], parameter.range);
      expect_range(found["anyOf"][1]["items"], parameter.range);
      EXPECT_EQ(found["anyOf"][1]["minItems"], 3);
      EXPECT_EQ(found["anyOf"][1]["maxItems"], 3);
      break;
    case ParameterType::interval:
    case ParameterType::list:
    case ParameterType::json:
      FAIL() << "no stage has such a parameter; test/experiments/file/schema_test.cpp covers them";
  }
}

void expect_parameters(const json& properties, const std::vector<ParameterDoc>& parameters) {
  for (const ParameterDoc& parameter : parameters) {
    SCOPED_TRACE(parameter.key);
    const json& found = properties.at(parameter.key);
    expect_value(found, parameter);
    EXPECT_EQ(found["description"], parameter.sentence);
    const bool has_default = !parameter.is_required && !parameter.is_optional;
    EXPECT_EQ(found.contains("default"), has_default);
    if (has_default) {
      EXPECT_EQ(found["default"], json::parse(parameter.default_json));
    }
  }
}

/// Expects that the stage's definition equals its table.
void expect_stage(const json& stage, const StageEntry& entry) {
  SCOPED_TRACE(entry.name);
  EXPECT_EQ(stage["additionalProperties"], false);
  EXPECT_EQ(stage["properties"][name_key(entry.kind)]["const"], entry.name);
  EXPECT_EQ(stage["properties"].size(), entry.parameters.size() + reserved_keys(entry.kind).size());
  expect_parameters(stage["properties"], entry.parameters);
  std::vector<std::string> required = required_keys(entry.parameters);
  required.insert(required.begin(), name_key(entry.kind));
  EXPECT_EQ(stage["required"], json(required));
}

TEST(Schema, EqualsTheTables) {
  const json definitions = definitions_of(registry());
  for (const StageEntry& entry : registry().entries()) {
    expect_stage(definitions.at(entry.kind + "." + entry.name), entry);
  }
}

TEST(Schema, EqualsTheTablesOfObjectsInAStage) {
  Catalogue catalogue;
  catalogue.add(test::nested_stage());
  expect_stage(definitions_of(catalogue).at("dataset.nested"), test::nested_stage());
}

TEST(Schema, OffersTheStagesOfEachKind) {
  const json definitions = definitions_of(registry());
  std::size_t stages = 0;
  const std::vector<StageKind> kinds = registry().kinds();
  for (const StageKind& kind : kinds) {
    const std::vector<std::string> names = registry().names(kind.name);
    stages += names.size();
    ASSERT_FALSE(names.empty()) << kind.name;
    const json& definition = definitions.at(kind.name);
    EXPECT_EQ(definition["properties"][name_key(kind.name)]["enum"], json(names));
    EXPECT_EQ(definition["oneOf"].size(), names.size());
  }
  EXPECT_EQ(definitions.size(), kinds.size() + stages);
}

TEST(Schema, AcceptsNoStageOfAKindThatHasNone) {
  Catalogue catalogue;
  catalogue.add(*registry().find("step", "registration"));
  const json definitions = definitions_of(catalogue);
  const json nothing = {{"not", json::object()}};
  EXPECT_EQ(definitions.at("icp"), nothing);
  EXPECT_EQ(definitions.at("dataset"), nothing);
}

}  // namespace
}  // namespace croon
