#include "framework/calibration/composition.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/calibration/calibrate_rig.hpp"
#include "framework/params/json_file.hpp"
#include "framework/pipeline/calibrate.hpp"

namespace croon {
namespace {

/// The list of steps in `document`; null if it has none.
nlohmann::json* steps_of(nlohmann::json& document) {
  nlohmann::json* steps = &document;
  if (document.is_object() && document.contains("pipeline")) steps = &document.at("pipeline");
  return steps->is_array() ? steps : nullptr;
}

bool has_step(const nlohmann::json& steps, const std::string& type) {
  return std::any_of(steps.begin(), steps.end(), [&](const nlohmann::json& step) {
    return step.is_object() && step.contains("step") && step.at("step") == type;
  });
}

/// Appends a verdict and a covariance if they are missing: unverified poses must not be accepted.
void append_missing_steps(nlohmann::json& steps) {
  for (const char* const type : {"verdict", "covariance"}) {
    if (!has_step(steps, type)) steps.push_back({{"step", type}});
  }
}

/// The parameters of a step; empty if the step is unknown.
std::vector<params::ParameterDoc> parameters_of(const nlohmann::json& step,
                                                const Catalogue& catalogue) {
  if (!step.is_object() || !step.contains("step") || !step.at("step").is_string()) return {};
  const StageEntry* const entry = catalogue.find(Step::kKind, step.at("step").get<std::string>());
  return entry == nullptr ? std::vector<params::ParameterDoc>() : entry->parameters;
}

/// Restricts the searches of the steps, and of the steps in their parameters, to poses near the
/// initial guess, unless the file sets `use_start` itself.
void stay_near_start(nlohmann::json& steps, const PoseBounds& nominal, const Catalogue& catalogue) {
  for (nlohmann::json& step : steps) {
    for (const params::ParameterDoc& doc : parameters_of(step, catalogue)) {
      if (doc.key == "use_start" && !step.contains("use_start")) {
        step["use_start"] = true;
        step.emplace("max_rotation_deg", deg_from_rad(nominal.rotation_rad));
        step.emplace("max_translation_m", nominal.translation_m);
      } else if (doc.stage_kind == Step::kKind) {
        nlohmann::json& inner = step[doc.key];
        if (inner.is_null()) inner = params::parse_json(doc.default_json, doc.key);
        if (inner.is_array()) stay_near_start(inner, nominal, catalogue);
      }
    }
  }
}

/// Sets `at_rest` of the steps that have this parameter. Throws InputError if none has.
void set_at_rest(nlohmann::json& steps, const std::string& file, const Catalogue& catalogue) {
  bool is_any = false;
  for (nlohmann::json& step : steps) {
    for (const params::ParameterDoc& doc : parameters_of(step, catalogue)) {
      if (doc.key != "at_rest") continue;
      step[doc.key] = true;
      is_any = true;
    }
  }
  if (!is_any) {
    throw InputError(file, "",
                     "expected a step time_check, because the rig is said to stand; found none");
  }
}

Composition composition_in(nlohmann::json document, const std::string& name,
                           const std::string& file, const CompositionOptions& options,
                           const Catalogue& catalogue) {
  Composition composition;
  composition.name = name;
  nlohmann::json* const steps = steps_of(document);
  if (steps == nullptr && document.is_object() && document.contains("extends")) {
    throw InputError(file, "", "expected a list of steps as \"pipeline\", found \"extends\" alone");
  }
  // Without steps, this throws the appropriate error.
  if (steps == nullptr || steps->empty()) pipeline_in(document, file, catalogue);
  append_missing_steps(*steps);
  if (options.at_rest) set_at_rest(*steps, file, catalogue);
  composition.from_nothing = pipeline_in(document, file, catalogue);
  stay_near_start(*steps, options.nominal, catalogue);
  composition.near_nominal = pipeline_in(document, file, catalogue);
  for (const NamedStep& step : composition.from_nothing) {
    const params::DataFlow& flow = step.step.flow();
    composition.target_channels.insert(flow.target_channels.begin(), flow.target_channels.end());
    composition.source_channels.insert(flow.source_channels.begin(), flow.source_channels.end());
    const std::set<std::string> channels = flow.channels();
    composition.channels.insert(channels.begin(), channels.end());
  }
  return composition;
}

}  // namespace

std::vector<std::string> recommended_pipeline_names() { return {"best", "paper"}; }

const std::string& recommended_pipeline_text(const std::string& name) {
  const std::vector<std::string> names = recommended_pipeline_names();
  if (std::find(names.begin(), names.end(), name) != names.end()) {
    return embedded_pipelines().at(name);
  }
  throw InputError("", "", "unknown pipeline \"" + name + "\"" + name_hint(name, names));
}

Composition composition_in_text(const std::string& text, const std::string& name,
                                const CompositionOptions& options, const Catalogue& catalogue) {
  return composition_in(params::parse_json(text, name), name, name, options, catalogue);
}

Composition composition_called(const std::string& pipeline, const CompositionOptions& options,
                               const Catalogue& catalogue) {
  const std::vector<std::string> names = recommended_pipeline_names();
  const bool is_recommended = std::find(names.begin(), names.end(), pipeline) != names.end();
  if (is_recommended) {
    return composition_in_text(embedded_pipelines().at(pipeline), pipeline, options, catalogue);
  }
  const std::filesystem::path file = pipeline;
  const bool is_path = file.has_parent_path() || file.extension() == ".json";
  if (!is_path && !std::filesystem::exists(file)) recommended_pipeline_text(pipeline);
  return composition_in(params::read_json_file(file), file.filename().string(), pipeline, options,
                        catalogue);
}

}  // namespace croon
