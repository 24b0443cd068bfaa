#include "experiments/file/replace_value.hpp"

#include <nlohmann/json.hpp>
#include <sstream>

#include "framework/base/nearest_name.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
using params::Node;

std::vector<std::string> words_between_dots(const std::string& path) {
  std::vector<std::string> words;
  std::istringstream stream(path);
  for (std::string word; std::getline(stream, word, '.');) words.push_back(word);
  if (path.empty() || path.back() == '.') words.push_back("");
  return words;
}

/// The entry of the stage of `kind` that `value` describes, or null.
const StageEntry* entry_of(const std::string& kind, const json& value, const Catalogue& catalogue) {
  const std::string key = name_key(kind);
  if (!value.is_object() || !value.contains(key) || !value.at(key).is_string()) return nullptr;
  return catalogue.find(kind, value.at(key).get<std::string>());
}

const params::ParameterDoc* find_parameter(const StageEntry& entry, const std::string& key) {
  for (const params::ParameterDoc& doc : entry.parameters) {
    if (doc.key == key) return &doc;
  }
  return nullptr;
}

std::string no_parameter(const StageEntry& entry, const std::string& key) {
  std::vector<std::string> known;
  for (const params::ParameterDoc& doc : entry.parameters) known.push_back(doc.key);
  return entry.kind + " \"" + entry.name + "\" has no parameter \"" + key + "\"" +
         name_hint(key, known);
}

/// Puts `value` in the place that `keys` lead to inside `step`.
std::string replace_inside(PatchedStep& step, const std::vector<std::string>& keys,
                           const Node& value, const Catalogue& catalogue) {
  json changed = *step.value;
  json* at = &changed;
  json::json_pointer part;
  std::string kind = Step::kKind;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const StageEntry* entry = entry_of(kind, *at, catalogue);
    // A stage that does not exist is noted where it stands; nothing is known of its parameters.
    if (entry == nullptr) return "";
    const params::ParameterDoc* doc = find_parameter(*entry, keys[i]);
    if (doc == nullptr) return no_parameter(*entry, keys[i]);
    part.push_back(keys[i]);
    const bool is_last = i + 1 == keys.size();
    if (!is_last && doc->type != params::ParameterType::stage) {
      return "\"" + keys[i] + "\" is not a stage: nothing below it can be replaced";
    }
    if (!is_last && !at->contains(keys[i])) (*at)[keys[i]] = json::parse(doc->default_json);
    at = &(*at)[keys[i]];
    kind = doc->stage_kind;
  }
  *at = value.value();
  step.value = std::make_shared<const json>(std::move(changed));
  set_origin(step.origins, {part.to_string(), value.pointer()});
  return "";
}

std::string replace_step(PatchedPipeline& pipeline, PatchedPipeline::iterator step,
                         const Node& value) {
  const std::string old_name = step->name;
  if (value.has("name")) {
    const std::string name = read_step_name(value);
    const auto other = find_step(pipeline, name);
    if (other != pipeline.end() && other != step) {
      return "two steps are called \"" + name + "\"";
    }
    step->name = name;
  }
  step->value = std::make_shared<const json>(value.value());
  step->origins = {{"", value.pointer()}};
  return "";
}

}  // namespace

std::string replace_value(PatchedPipeline& pipeline, const std::string& path, const Node& value,
                          const Catalogue& catalogue) {
  std::vector<std::string> words = words_between_dots(path);
  const auto step = find_step(pipeline, words.front());
  if (step == pipeline.end()) return no_step(pipeline, words.front());
  words.erase(words.begin());
  if (words.empty()) return replace_step(pipeline, step, value);
  return replace_inside(*step, words, value, catalogue);
}

}  // namespace croon::experiments
