#include "framework/params/group.hpp"

#include <nlohmann/json.hpp>

namespace croon::params {
const NameRule kKeyName = {"_-", "a name of letters, digits, _ and -, not starting with -", "-"};

std::vector<std::string> read_names(const Node& node, const std::string& name_words) {
  std::vector<std::string> names;
  if (!node.is_object()) return names;
  for (const auto& [name, value] : node.value().items()) {
    names.push_back(name);
    if (kKeyName.allows(name)) continue;
    node.member(name).fault("expected " + name_words + ", " + kKeyName.words + ", found " +
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
