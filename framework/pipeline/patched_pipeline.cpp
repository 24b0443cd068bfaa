#include "framework/pipeline/patched_pipeline.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/params/group.hpp"

namespace croon {
namespace {

using nlohmann::json;
using params::Node;

std::vector<std::string> step_names(const PatchedPipeline& pipeline) {
  std::vector<std::string> names;
  for (const PatchedStep& step : pipeline) names.push_back(step.name);
  return names;
}

/// The step called `name`, or the end.
PatchedPipeline::iterator find_step(PatchedPipeline& pipeline, const std::string& name) {
  return std::find_if(pipeline.begin(), pipeline.end(),
                      [&](const PatchedStep& step) { return step.name == name; });
}

std::string no_step(const PatchedPipeline& pipeline, const std::string& name) {
  return "there is no step \"" + name + "\"" + name_hint(name, step_names(pipeline));
}

std::string two_steps(const std::string& name) { return "two steps are called \"" + name + "\""; }

/// The step's "name", else its type. Notes a fault for an invalid name.
std::string read_step_name(const Node& step) {
  if (!step.has("name")) {
    // A type that is not a string is noted as a fault when the step is built.
    const bool has_type = step.has("step") && step.value().at("step").is_string();
    return has_type ? step.value().at("step").get<std::string>() : "";
  }
  std::string name;
  const Node member = step.member("name");
  if (!member.read(name)) return name;
  const std::string too_long = why_too_long(name, kMaxNameBytes);
  if (!too_long.empty()) {
    member.fault(too_long);
  } else if (!params::kKeyName.allows(name)) {
    member.expected(params::kKeyName.words);
  }
  return name;
}

PatchedStep patched_step(const std::string& name, const Node& step) {
  return {name, std::make_shared<const json>(step.value()), {{"", step.file(), step.pointer()}}};
}

/// Whether the JSON pointer `part` refers to `pointer` or to a value that contains it.
bool contains(const std::string& part, const std::string& pointer) {
  return pointer.compare(0, part.size(), part) == 0 &&
         (pointer.size() == part.size() || pointer[part.size()] == '/');
}

/// Records that `origin.part` of a step was written at `origin`.
void set_origin(std::vector<Origin>& origins, const Origin& origin) {
  const auto is_replaced = [&](const Origin& other) { return contains(origin.part, other.part); };
  origins.erase(std::remove_if(origins.begin(), origins.end(), is_replaced), origins.end());
  origins.push_back(origin);
}

/// The origin of the value at `pointer`. Later elements of the list were set later.
std::vector<Origin>::const_iterator origin_of(const std::vector<Origin>& origins,
                                              const std::string& pointer) {
  auto nearest = origins.end();
  for (auto origin = origins.begin(); origin != origins.end(); ++origin) {
    if (contains(origin->part, pointer) &&
        (nearest == origins.end() || origin->part.size() > nearest->part.size())) {
      nearest = origin;
    }
  }
  return nearest;
}

/// Converts `fault`, whose pointer is relative to the step, to the file and pointer where the value
/// was written. If several values break a rule together, the one set last is reported.
Fault located(Fault fault, const std::vector<Origin>& origins) {
  std::string pointer = fault.where == "/" ? "" : fault.where;
  auto origin = origin_of(origins, pointer);
  for (const std::string& part : fault.parts) {
    const auto of_part = origin_of(origins, part);
    if (of_part <= origin) continue;
    origin = of_part;
    pointer = part;
  }
  fault.file = origin->file;
  fault.where = origin->pointer + pointer.substr(origin->part.size());
  fault.parts.clear();
  return fault;
}

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

/// The parameter with the present or former name `key`, or null.
const params::ParameterDoc* find_parameter(const StageEntry& entry, const std::string& key) {
  for (const params::ParameterDoc& doc : entry.parameters) {
    if (doc.key == key || (!key.empty() && doc.former_key == key)) return &doc;
  }
  return nullptr;
}

std::string no_parameter(const StageEntry& entry, const std::string& key) {
  std::vector<std::string> known;
  for (const params::ParameterDoc& doc : entry.parameters) known.push_back(doc.key);
  return entry.kind + " \"" + entry.name + "\" has no parameter \"" + key + "\"" +
         name_hint(key, known);
}

/// Whether the value at `part` of a step was written in the same object as `value`.
bool is_beside(const std::vector<Origin>& origins, const std::string& part, const Node& value) {
  const auto object = [](const std::string& pointer) {
    return json::json_pointer(pointer).parent_pointer();
  };
  return std::any_of(origins.begin(), origins.end(), [&](const Origin& origin) {
    return origin.part == part && origin.file == value.file() &&
           object(origin.pointer) == object(value.pointer());
  });
}

/// Replaces the value at `keys` inside `step` with `value`.
std::string replace_inside(PatchedStep& step, const std::vector<std::string>& keys,
                           const Node& value, const Catalogue& catalogue) {
  json changed = *step.value;
  json* at = &changed;
  json::json_pointer part;
  std::string kind = Step::kKind;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const StageEntry* entry = entry_of(kind, *at, catalogue);
    // The fault of an unknown stage is noted when it is built; its parameters are unknown.
    if (entry == nullptr) return "";
    const params::ParameterDoc* doc = find_parameter(*entry, keys[i]);
    if (doc == nullptr) return no_parameter(*entry, keys[i]);
    // The new value replaces one that was written with the other name of the parameter.
    const std::string& other = keys[i] == doc->key ? doc->former_key : doc->key;
    if (!other.empty() && at->contains(other)) {
      if (is_beside(step.origins, (part / other).to_string(), value)) {
        return "expected \"" + doc->key + "\" without its former name, found both";
      }
      (*at)[keys[i]] = at->at(other);
      at->erase(other);
    }
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
  set_origin(step.origins, {part.to_string(), value.file(), value.pointer()});
  return "";
}

std::string replace_step(PatchedPipeline& pipeline, PatchedPipeline::iterator step,
                         const Node& value) {
  std::string name = step->name;
  if (value.has("name")) {
    name = read_step_name(value);
    const auto other = find_step(pipeline, name);
    if (other != pipeline.end() && other != step) return two_steps(name);
  }
  *step = patched_step(name, value);
  return "";
}

}  // namespace

PatchedPipeline read_steps(const Node& pipeline) {
  PatchedPipeline steps;
  if (!pipeline.is_array()) return steps;
  const std::size_t count = pipeline.value().size();
  if (count == 0) pipeline.expected("a list of at least one step");
  if (count > kMaxSteps) {
    pipeline.fault("expected a list of at most " + std::to_string(kMaxSteps) + " steps, found " +
                   std::to_string(count));
    return steps;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Node step = pipeline.element(i);
    const std::string name = read_step_name(step);
    if (!name.empty() && find_step(steps, name) != steps.end()) {
      step.fault(two_steps(name) + ": give one of them a \"name\"");
    }
    steps.push_back(patched_step(name, step));
  }
  return steps;
}

std::string insert_step(PatchedPipeline& pipeline, const std::string& anchor, bool is_after,
                        const Node& step) {
  const auto found = find_step(pipeline, anchor);
  if (found == pipeline.end()) return no_step(pipeline, anchor);
  const std::string name = read_step_name(step);
  if (!name.empty() && find_step(pipeline, name) != pipeline.end()) {
    return two_steps(name) + ": give the inserted one a \"name\"";
  }
  pipeline.insert(is_after ? found + 1 : found, patched_step(name, step));
  return "";
}

std::string remove_step(PatchedPipeline& pipeline, const std::string& name) {
  const auto step = find_step(pipeline, name);
  if (step == pipeline.end()) return no_step(pipeline, name);
  pipeline.erase(step);
  return "";
}

std::string replace_value(PatchedPipeline& pipeline, const std::string& path, const Node& value,
                          const Catalogue& catalogue) {
  std::vector<std::string> words = words_between_dots(path);
  const auto step = find_step(pipeline, words.front());
  if (step == pipeline.end()) return no_step(pipeline, words.front());
  words.erase(words.begin());
  if (words.empty()) return replace_step(pipeline, step, value);
  return replace_inside(*step, words, value, catalogue);
}

Pipeline build_pipeline(const PatchedPipeline& pipeline, const Catalogue& catalogue,
                        std::vector<Fault>& faults) {
  Pipeline built;
  for (const PatchedStep& step : pipeline) {
    std::vector<Fault> step_faults, notes;
    const params::Slot<Step> slot =
        catalogue.slot<Step>(Node(*step.value, "", step_faults).noting(notes));
    for (const Fault& fault : step_faults) faults.push_back(located(fault, step.origins));
    if (!step_faults.empty()) continue;
    for (Fault& note : notes) note = located(note, step.origins);
    built.push_back({step.name, slot, notes});
  }
  return built;
}

Fault fault_of_step(const PatchedStep& step, const std::string& message) {
  return located({"", "/", "the step \"" + step.name + "\" " + message}, step.origins);
}

std::vector<Fault> unmet_needs(const PatchedPipeline& pipeline, const Pipeline& built) {
  std::vector<Fault> faults;
  std::map<std::string, params::ExtraDoc> given;
  for (std::size_t i = 0; i < built.size(); ++i) {
    const params::DataFlow& flow = built[i].step.flow();
    for (const params::ExtraDoc& extra : flow.takes) {
      const auto found = given.find(extra.name);
      if (found != given.end() && found->second.type == extra.type) continue;
      std::vector<std::string> names;
      for (const auto& [name, doc] : given) names.push_back(name);
      const std::string why = found == given.end()
                                  ? "which no earlier step provides" + name_hint(extra.name, names)
                                  : "which an earlier step provides with another type";
      faults.push_back(fault_of_step(
          pipeline[i], "needs the extra \"" + extra.name + "\" (" + extra.meaning + "), " + why));
    }
    for (const params::ExtraDoc& extra : flow.gives) given[extra.name] = extra;
  }
  return faults;
}

}  // namespace croon
