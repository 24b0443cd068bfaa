#include <algorithm>

#include "registry/help_formats.hpp"
#include "registry/words.hpp"

namespace croon {
namespace {

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, text.size()), ' ');
}

std::string as_it_is(const std::string& word) { return word; }

}  // namespace

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

std::string text_page(const StageEntry& stage) {
  std::string text =
      stage.kind + "/" + stage.name + "\n  " + stage.summary + "\n  Source: " + stage.source + "\n";
  for (const auto& [path, parameter] : placed_parameters(stage.parameters)) {
    const std::string standard =
        parameter->is_required ? "required" : "default " + default_words(*parameter);
    text += "\n  " + path + ": " + type_words(*parameter, as_it_is) + "; " + standard + "\n      " +
            parameter->sentence + "\n";
  }
  if (stage.parameters.empty()) text += "\n  It has no parameters.\n";
  return text;
}

}  // namespace croon
