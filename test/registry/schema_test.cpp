#include "registry/schema.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "registry/registry.hpp"

namespace croon {
namespace {

using nlohmann::json;
using params::ParameterDoc;
using params::ParameterType;

json schema() {
  static const json schema = json::parse(experiment_schema(registry()));
  return schema;
}

/// Expects the ends of the range, or none where there are none.
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
  }
}

TEST(Schema, EqualsTheTables) {
  const json definitions = schema()["$defs"];
  for (const StageEntry& entry : registry().entries()) {
    const json& stage = definitions.at(entry.kind + "." + entry.name);
    EXPECT_EQ(stage["additionalProperties"], false);
    EXPECT_EQ(stage["properties"][name_key(entry.kind)]["const"], entry.name);
    EXPECT_EQ(stage["properties"].size(),
              entry.parameters.size() + reserved_keys(entry.kind).size());
    json required = {name_key(entry.kind)};
    for (const ParameterDoc& parameter : entry.parameters) {
      SCOPED_TRACE(entry.name + "." + parameter.key);
      const json& found = stage["properties"].at(parameter.key);
      expect_value(found, parameter);
      EXPECT_EQ(found["description"], parameter.sentence);
      EXPECT_EQ(found.contains("default"), !parameter.is_required);
      if (parameter.is_required) {
        required.push_back(parameter.key);
      } else {
        EXPECT_EQ(found["default"], json::parse(parameter.default_json));
      }
    }
    EXPECT_EQ(stage["required"], required);
  }
}

TEST(Schema, OffersTheStagesOfEachKind) {
  const json definitions = schema()["$defs"];
  std::size_t stages = 0;
  for (const std::string& kind : stage_kinds()) {
    const std::vector<std::string> names = registry().names(kind);
    stages += names.size();
    ASSERT_FALSE(names.empty()) << kind;
    EXPECT_EQ(definitions.at(kind)["properties"][name_key(kind)]["enum"], json(names));
    EXPECT_EQ(definitions.at(kind)["oneOf"].size(), names.size());
  }
  EXPECT_EQ(definitions.size(), stage_kinds().size() + stages);
}

/// Every `$ref` leads somewhere.
void expect_references(const json& part, const json& whole) {
  if (part.is_object() && part.contains("$ref")) {
    const std::string reference = part["$ref"].get<std::string>();
    EXPECT_TRUE(whole.contains(json::json_pointer(reference.substr(1)))) << reference;
  }
  if (!part.is_structured()) return;
  for (const json& below : part) expect_references(below, whole);
}

TEST(Schema, ReferencesLeadSomewhere) { expect_references(schema(), schema()); }

}  // namespace
}  // namespace croon
