#include "framework/stage/catalogue.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

#include "framework/base/nearest_name.hpp"

namespace croon {
namespace {

/// Where a kind stands among stage_kinds().
std::ptrdiff_t kind_rank(const std::string& kind) {
  const std::vector<std::string>& kinds = stage_kinds();
  return std::find(kinds.begin(), kinds.end(), kind) - kinds.begin();
}

/// "a step", "an icp".
std::string with_article(const std::string& kind) {
  const bool has_vowel = std::string("aeiou").find(kind.front()) != std::string::npos;
  return (has_vowel ? "an " : "a ") + kind;
}

bool comes_before(const StageEntry& a, const StageEntry& b) {
  return std::make_tuple(kind_rank(a.kind), a.name) < std::make_tuple(kind_rank(b.kind), b.name);
}

}  // namespace

const std::vector<std::string>& stage_kinds() {
  static const std::vector<std::string> kinds = {"dataset",     "preprocessor", "ground_extractor",
                                                 "yaw_search",  "icp",          "volume_scorer",
                                                 "pose_search", "step"};
  return kinds;
}

void Catalogue::add(StageEntry entry) {
  if (kind_rank(entry.kind) == static_cast<std::ptrdiff_t>(stage_kinds().size())) {
    throw std::logic_error("no kind of stage \"" + entry.kind + "\"");
  }
  if (find(entry.kind, entry.name) != nullptr) {
    throw std::logic_error("two stages " + entry.kind + "/" + entry.name);
  }
  const auto place = std::upper_bound(entries_.begin(), entries_.end(), entry, comes_before);
  entries_.insert(place, std::move(entry));
}

const StageEntry* Catalogue::find(const std::string& kind, const std::string& name) const {
  for (const StageEntry& entry : entries_) {
    if (entry.kind == kind && entry.name == name) return &entry;
  }
  return nullptr;
}

std::vector<std::string> Catalogue::names(const std::string& kind) const {
  std::vector<std::string> names;
  for (const StageEntry& entry : entries_) {
    if (entry.kind == kind) names.push_back(entry.name);
  }
  return names;
}

params::BuiltStage Catalogue::build(const std::string& kind, const params::Node& node) const {
  const std::string key = name_key(kind);
  std::string name;
  if (!node.is_object() || !node.require(key) || !node.member(key).read(name)) return {};
  const StageEntry* entry = find(kind, name);
  if (entry == nullptr) {
    node.member(key).fault("expected " + with_article(kind) + ", found \"" + name + "\"" +
                           name_hint(name, names(kind)));
    return {};
  }
  return entry->build(node, *this);
}

}  // namespace croon
