#include "experiments/store/header_differences.hpp"

#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;

constexpr std::size_t kShownDifferences = 3;
constexpr std::size_t kShownCharacters = 60;

/// `value` on one line, cut if it is long.
std::string shown(const json& value) {
  const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  return text.size() <= kShownCharacters ? text : text.substr(0, kShownCharacters) + "...";
}

/// A JSON pointer as the user knows it: "~1" is a slash in a file name.
std::string readable(std::string pointer) {
  for (std::size_t at = pointer.find("~1"); at != std::string::npos; at = pointer.find("~1", at)) {
    pointer.replace(at, 2, "/");
  }
  return pointer;
}

/// Adds the differences of two JSON texts, with pointers below `where`.
void add_differences(std::vector<std::string>& to, const std::string& where,
                     const std::string& stored, const std::string& asked) {
  if (stored == asked) return;
  const json was = json::parse(stored, nullptr, false);
  const json is = json::parse(asked, nullptr, false);
  if (was.is_discarded() || is.is_discarded()) {
    to.push_back(where + " differs");
    return;
  }
  for (const json& change : json::diff(was, is)) {
    const json::json_pointer pointer(change["path"].get<std::string>());
    std::string text = where + readable(pointer.to_string());
    if (change["op"] == "add") text += " was not there and is " + shown(change["value"]);
    if (change["op"] == "remove") text += " was " + shown(was[pointer]) + " and is not there";
    if (change["op"] == "replace") {
      text += " was " + shown(was[pointer]) + " and is " + shown(change["value"]);
    }
    to.push_back(text);
  }
}

}  // namespace

std::vector<std::string> differences(const StoreHeader& stored, const StoreHeader& asked) {
  std::vector<std::string> found;
  Provenance names = asked.provenance;
  names.insert(stored.provenance.begin(), stored.provenance.end());
  const auto value = [](const Provenance& of, const std::string& name) {
    const auto entry = of.find(name);
    return entry == of.end() ? std::string("null") : entry->second;
  };
  for (const auto& [name, any] : names) {
    const std::string was = value(stored.provenance, name), is = value(asked.provenance, name);
    if (name != "program") {
      add_differences(found, "/" + name, was, is);
    } else if (was != is) {
      found.push_back("the program was another build of croon");
    }
  }
  for (const StoredName& variant : asked.variants) {
    for (const StoredName& other : stored.variants) {
      if (other.name != variant.name) continue;
      add_differences(found, "/variants/" + variant.name, other.detail, variant.detail);
    }
  }
  return found;
}

void refuse_differences(const std::string& file, const StoreHeader& stored,
                        const StoreHeader& asked, const std::string& remedy) {
  const std::vector<std::string> found = differences(stored, asked);
  if (found.empty()) return;
  std::string text;
  for (std::size_t i = 0; i < found.size() && i < kShownDifferences; ++i) {
    text += (i == 0 ? "" : "; ") + found[i];
  }
  if (found.size() > kShownDifferences) {
    text += "; and " + std::to_string(found.size() - kShownDifferences) + " more";
  }
  throw InputError(file, "", "its trials were made from something else: " + text + "; " + remedy);
}

}  // namespace croon::experiments
