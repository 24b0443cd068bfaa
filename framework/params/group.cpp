#include "framework/params/group.hpp"

#include <algorithm>
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

std::string map_json(const Members& members) {
  const auto is_unsorted = [](const auto& a, const auto& b) { return a.first >= b.first; };
  if (std::adjacent_find(members.begin(), members.end(), is_unsorted) != members.end()) {
    throw std::logic_error("the names of a map must be in alphabetical order");
  }
  return object_json(members);
}

}  // namespace croon::params
