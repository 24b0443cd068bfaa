#include "framework/params/group.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace croon::params {
namespace {

bool is_name(const std::string& text) {
  const std::string others = "_-";
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return is_letter || (c >= '0' && c <= '9') || others.find(c) != std::string::npos;
  });
}

}  // namespace

std::vector<std::string> read_names(const Node& node, const std::string& name_words) {
  std::vector<std::string> names;
  if (!node.is_object()) return names;
  for (const auto& [name, value] : node.value().items()) {
    names.push_back(name);
    if (is_name(name)) continue;
    node.member(name).fault("expected " + name_words + " of letters, digits, _ and -, found " +
                            value_json(name));
  }
  if (names.empty()) node.expected("an object with " + name_words + " for each key");
  return names;
}

std::string map_json(const std::vector<std::pair<std::string, std::string>>& named_json) {
  std::string text;
  for (std::size_t i = 0; i < named_json.size(); ++i) {
    const auto& [name, value] = named_json[i];
    if (i > 0 && !(named_json[i - 1].first < name)) {
      throw std::logic_error("the name \"" + name + "\" must come before \"" +
                             named_json[i - 1].first + "\"");
    }
    text += (i == 0 ? "" : ",") + value_json(name) + ":" + value;
  }
  return "{" + text + "}";
}

}  // namespace croon::params
