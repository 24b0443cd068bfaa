#include "experiments/file/patched_pipeline.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/file/names.hpp"
#include "framework/base/nearest_name.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
using params::Node;

std::vector<std::string> step_names(const PatchedPipeline& pipeline) {
  std::vector<std::string> names;
  for (const PatchedStep& step : pipeline) names.push_back(step.name);
  return names;
}

/// True where the JSON pointer `part` leads to `pointer` or to something around it.
bool holds(const std::string& part, const std::string& pointer) {
  return pointer.compare(0, part.size(), part) == 0 &&
         (pointer.size() == part.size() || pointer[part.size()] == '/');
}

/// The place in the file of what stands at `pointer` in the step.
std::string place_of(const std::vector<Origin>& origins, std::string pointer) {
  if (pointer == "/") pointer.clear();
  const Origin* nearest = nullptr;
  for (const Origin& origin : origins) {
    if (holds(origin.part, pointer) &&
        (nearest == nullptr || origin.part.size() > nearest->part.size())) {
      nearest = &origin;
    }
  }
  return nearest->place + pointer.substr(nearest->part.size());
}

}  // namespace

PatchedPipeline::iterator find_step(PatchedPipeline& pipeline, const std::string& name) {
  return std::find_if(pipeline.begin(), pipeline.end(),
                      [&](const PatchedStep& step) { return step.name == name; });
}

std::string no_step(const PatchedPipeline& pipeline, const std::string& name) {
  return "there is no step \"" + name + "\"" + name_hint(name, step_names(pipeline));
}

std::string read_step_name(const Node& step) {
  if (!step.has("name")) {
    // A type that is not a string is noted when the step is built.
    const bool has_type = step.has("step") && step.value().at("step").is_string();
    return has_type ? step.value().at("step").get<std::string>() : "";
  }
  std::string name;
  if (step.member("name").read(name) && !is_step_name(name)) {
    step.member("name").expected("a name of letters, digits, _ and -");
  }
  return name;
}

void set_origin(std::vector<Origin>& origins, const Origin& origin) {
  const auto is_replaced = [&](const Origin& other) { return holds(origin.part, other.part); };
  origins.erase(std::remove_if(origins.begin(), origins.end(), is_replaced), origins.end());
  origins.push_back(origin);
}

PatchedPipeline read_steps(const Node& pipeline) {
  PatchedPipeline steps;
  if (!pipeline.is_array()) return steps;
  if (pipeline.value().empty()) pipeline.expected("a list of at least one step");
  for (std::size_t i = 0; i < pipeline.value().size(); ++i) {
    const Node step = pipeline.element(i);
    const std::string name = read_step_name(step);
    if (!name.empty() && find_step(steps, name) != steps.end()) {
      step.fault("two steps are called \"" + name + "\": give one of them a \"name\"");
    }
    steps.push_back({name, std::make_shared<const json>(step.value()), {{"", step.pointer()}}});
  }
  return steps;
}

std::string remove_step(PatchedPipeline& pipeline, const std::string& name) {
  const auto step = find_step(pipeline, name);
  if (step == pipeline.end()) return no_step(pipeline, name);
  pipeline.erase(step);
  return "";
}

Pipeline build_pipeline(const PatchedPipeline& pipeline, const Catalogue& catalogue,
                        const std::string& file, std::vector<Fault>& faults,
                        std::string& resolved) {
  Pipeline built;
  resolved.clear();
  for (const PatchedStep& step : pipeline) {
    std::vector<Fault> step_faults;
    const params::Slot<Step> slot = catalogue.slot<Step>(Node(*step.value, file, step_faults));
    for (Fault& fault : step_faults) {
      fault.where = place_of(step.origins, fault.where);
      faults.push_back(std::move(fault));
    }
    if (!step_faults.empty()) continue;
    built.push_back({step.name, slot});
    resolved += (resolved.empty() ? "" : ",") + ("{\"name\":" + json(step.name).dump()) + "," +
                slot.resolved().substr(1);
  }
  resolved = "[" + resolved + "]";
  return built;
}

}  // namespace croon::experiments
