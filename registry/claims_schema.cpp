#include <nlohmann/json.hpp>

#include "registry/schema_parts.hpp"

namespace croon {
namespace {

using nlohmann::ordered_json;
using params::ParameterDoc;
using params::ParameterType;

const std::vector<std::string> kShares = {"success", "scenes"};
const std::vector<std::string> kOfTrials = {"mean", "std", "median", "rmse", "p95"};

ParameterDoc text(const std::string& key, const std::string& sentence, bool is_required) {
  return {key, ParameterType::text, R"("")", {}, {}, "", sentence, is_required};
}

ParameterDoc word(const std::string& key, const std::vector<std::string>& words,
                  const std::string& sentence, bool is_required) {
  return {key, ParameterType::choice, R"("")", {}, words, "", sentence, is_required};
}

ParameterDoc number(const std::string& key, const std::string& sentence) {
  return {key, ParameterType::number, "", {}, {}, "", sentence, true};
}

/// The object whose keys are `parameters`; what is not required has no default.
ordered_json object_of(const std::vector<ParameterDoc>& parameters) {
  ordered_json properties;
  ordered_json required = ordered_json::array();
  for (const ParameterDoc& parameter : parameters) {
    properties[parameter.key] = parameter_schema(parameter);
    properties[parameter.key].erase("default");
    if (parameter.is_required) required.push_back(parameter.key);
  }
  return {{"type", "object"},
          {"properties", properties},
          {"required", required},
          {"additionalProperties", false}};
}

ordered_json list_of(const ordered_json& items, const std::string& description) {
  return {{"type", "array"}, {"description", description}, {"items", items}};
}

ordered_json expectation_schema() {
  std::vector<std::string> statistics = kShares;
  statistics.insert(statistics.end(), kOfTrials.begin(), kOfTrials.end());
  statistics.insert(statistics.end(), {"within_scene_std", "across_scenes_std"});
  ordered_json schema = object_of(
      {text("claim", "What the number is, in words.", true),
       text("source", "Where it stands.", true),
       text("variant", "The variant that is meant; the first where none is named.", false),
       text("sensor", "The sensor that is meant; all together where none is named.", false),
       word("measure", {"roll", "pitch", "yaw", "x", "y", "z", "rotation", "translation"},
            "What is measured, in deg or m; shares have none.", false),
       word("statistic", statistics, "Which statistic; success and scenes are shares in %.", true),
       number("value", "What the source says, in deg, m or %."),
       {"band", ParameterType::numbers, "", {}, {}, "", "Lowest and highest of ours.", true},
       text("why", "Why ours may differ.", false)});
  schema["properties"]["band"]["minItems"] = 2;
  schema["properties"]["band"]["maxItems"] = 2;
  schema["if"] = {{"properties", {{"statistic", {{"enum", kShares}}}}}};
  schema["then"] = {{"not", {{"required", {"measure"}}}}};
  schema["else"] = {{"required", {"measure"}}};
  return schema;
}

ordered_json quoted_schema() {
  return object_of(
      {text("method", "The method's name.", true), text("source", "Where its numbers stand.", true),
       word("statistic", kOfTrials, "Which statistic the numbers are.", true),
       number("pitch_deg", "Its error in pitch."), number("roll_deg", "Its error in roll."),
       number("yaw_deg", "Its error in yaw."), number("x_m", "Its error in x."),
       number("y_m", "Its error in y."), number("z_m", "Its error in z.")});
}

}  // namespace

ordered_json claims_properties() {
  return {{"expect",
           list_of(expectation_schema(),
                   "What a source claims, and the band in which ours must lie; decides no trial.")},
          {"quoted", list_of(quoted_schema(),
                             "Rows of other methods, beside which that of this one is printed.")}};
}

}  // namespace croon
