#include "registry/help_parts.hpp"

namespace croon {
namespace {

const char* const kGenerated =
    "<!-- Written by `croon stages --markdown`; `make docs` regenerates it. -->\n\n";

std::string code(const std::string& text) { return "`" + text + "`"; }

std::string linked_kind(const std::string& kind) { return "[" + code(kind) + "](" + kind + ".md)"; }

/// Words as code, kinds as links to their pages.
std::string parameter_type(const params::ParameterDoc& parameter) {
  return type_words(parameter, parameter.stage_kind.empty() ? code : linked_kind);
}

/// The shortest JSON that names the stage.
std::string example(const StageEntry& stage) {
  return "{\"" + name_key(stage.kind) + "\": \"" + stage.name + "\"}";
}

}  // namespace

std::string markdown_section(const StageEntry& stage) {
  std::string text = "## " + code(stage.name) + "\n\n" + stage.summary +
                     "\n\nSource: " + stage.source + ". In JSON: " + code(example(stage)) + "\n";
  for (const auto& [verb, what] : flow_lines(stage.flow, code)) {
    text += "\n" + verb + " " + what + ".\n";
  }
  if (stage.parameters.empty()) return text + "\nIt has no parameters.\n";
  text += "\n| parameter | type | default | description |\n|---|---|---|---|\n";
  for (const auto& [path, parameter] : placed_parameters(stage.parameters)) {
    const std::string standard =
        parameter->is_required ? "required" : code(default_words(*parameter));
    text += "| " + code(path) + " | " + parameter_type(*parameter) + " | " + standard + " | " +
            parameter->sentence + " |\n";
  }
  return text;
}

std::string markdown_page(const StageList& stages) {
  const StageEntry& first = *stages.front();
  std::string text = kGenerated + ("# " + code(first.kind)) + "\n\n" + first.kind_summary + "\n";
  for (const StageEntry* stage : stages) text += "\n" + markdown_section(*stage);
  return text;
}

std::string markdown_index(const StageList& stages) {
  std::string text = kGenerated + std::string("# Stages\n");
  std::string kind;
  for (const StageEntry* stage : stages) {
    if (stage->kind != kind) {
      kind = stage->kind;
      text += "\n## " + linked_kind(kind) + "\n\n" + stage->kind_summary + "\n\n";
    }
    text += "- [" + code(stage->name) + "](" + kind + ".md#" + stage->name +
            "): " + stage->summary + "\n";
  }
  return text;
}

}  // namespace croon
