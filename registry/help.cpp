#include "registry/help.hpp"

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"
#include "registry/help_parts.hpp"

namespace croon {
namespace {

/// The requested stages: all (both empty), those of a kind, or one.
struct Selection {
  std::string kind;
  std::string name;
};

std::vector<std::string> kind_names(const Catalogue& catalogue) {
  std::vector<std::string> names;
  for (const StageKind& kind : catalogue.kinds()) names.push_back(kind.name);
  return names;
}

Selection selection_from(const Catalogue& catalogue, const std::string& which) {
  const std::size_t slash = which.find('/');
  Selection selection{which.substr(0, slash), ""};
  const std::vector<std::string> kinds = kind_names(catalogue);
  if (!which.empty() && std::find(kinds.begin(), kinds.end(), selection.kind) == kinds.end()) {
    throw InputError("", "",
                     "expected a kind of stage, found \"" + selection.kind + "\"" +
                         name_hint(selection.kind, kinds));
  }
  if (slash == std::string::npos) return selection;
  selection.name = which.substr(slash + 1);
  if (catalogue.find(selection.kind, selection.name) == nullptr) {
    throw InputError("", "",
                     "expected " + kind_phrase(selection.kind) + ", found \"" + selection.name +
                         "\"" + name_hint(selection.name, catalogue.names(selection.kind)));
  }
  return selection;
}

StageList selected(const Catalogue& catalogue, const Selection& selection) {
  StageList stages;
  for (const StageEntry& entry : catalogue.entries()) {
    if (!selection.kind.empty() && entry.kind != selection.kind) continue;
    if (!selection.name.empty() && entry.name != selection.name) continue;
    stages.push_back(&entry);
  }
  return stages;
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, text.size()), ' ');
}

std::string as_it_is(const std::string& word) { return word; }

/// One line per stage, in columns: kind, name, summary.
std::string text_table(const StageList& stages) {
  std::size_t kind_width = 0;
  std::size_t name_width = 0;
  for (const StageEntry* stage : stages) {
    kind_width = std::max(kind_width, stage->kind.size());
    name_width = std::max(name_width, stage->name.size());
  }
  std::string text;
  for (const StageEntry* stage : stages) {
    text += padded(stage->kind, kind_width) + "  " + padded(stage->name, name_width) + "  " +
            stage->summary + "\n";
  }
  return text;
}

/// One stage with its parameters, for a terminal.
std::string text_page(const StageEntry& stage) {
  std::string text =
      stage.kind + "/" + stage.name + "\n  " + stage.summary + "\n  Source: " + stage.source + "\n";
  for (const auto& [verb, what] : flow_lines(stage.flow, as_it_is)) {
    text += "  " + verb + " " + what + ".\n";
  }
  for (const auto& [path, parameter] : placed_parameters(stage.parameters)) {
    const std::string standard =
        parameter->is_required ? "required" : "default " + default_words(*parameter);
    text += "\n  " + path + ": " + type_words(*parameter, as_it_is) + "; " + standard + "\n      " +
            parameter->sentence + "\n";
  }
  if (stage.parameters.empty()) text += "\n  It has no parameters.\n";
  return text;
}

std::string markdown(const Selection& selection, const StageList& stages) {
  if (selection.kind.empty()) return markdown_index(stages);
  if (selection.name.empty()) return markdown_page(stages);
  return markdown_section(*stages.front());
}

}  // namespace

HelpFormat help_format(const std::string& name) {
  if (name == "text") return HelpFormat::text;
  if (name == "json") return HelpFormat::json;
  if (name == "markdown") return HelpFormat::markdown;
  throw InputError("", "format", "expected text, json or markdown, found " + in_quotes(name));
}

std::string stages_help(const Catalogue& catalogue, const std::string& which, HelpFormat format) {
  const Selection selection = selection_from(catalogue, which);
  const StageList stages = selected(catalogue, selection);
  if (format == HelpFormat::json) return json_list(stages);
  if (format == HelpFormat::markdown) return markdown(selection, stages);
  return selection.name.empty() ? text_table(stages) : text_page(*stages.front());
}

}  // namespace croon
