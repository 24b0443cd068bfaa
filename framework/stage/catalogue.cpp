#include "framework/stage/catalogue.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "framework/base/error.hpp"

namespace croon {
namespace {

/// The kind with its indefinite article: "a step", "an icp".
std::string with_article(const std::string& kind) {
  const bool has_vowel = std::string("aeiou").find(kind.front()) != std::string::npos;
  return (has_vowel ? "an " : "a ") + kind;
}

/// Builds the stages in the slots of a stage and collects their versions and data flows.
class SlotBuilder final : public params::StageBuilder {
 public:
  explicit SlotBuilder(const Catalogue& catalogue) : catalogue_(catalogue) {}

  params::BuiltStage build(const std::string& kind, const params::Node& node) const override {
    params::BuiltStage built = catalogue_.build(kind, node);
    versions_.insert(built.versions.begin(), built.versions.end());
    if (built.flow) flow_.add(*built.flow);
    return built;
  }

  const params::StageVersions& versions() const { return versions_; }
  const params::DataFlow& flow() const { return flow_; }

 private:
  const Catalogue& catalogue_;
  mutable params::StageVersions versions_;
  mutable params::DataFlow flow_;
};

bool comes_before(const StageEntry& a, const StageEntry& b) {
  return std::tie(a.kind_order, a.kind, a.name) < std::tie(b.kind_order, b.kind, b.name);
}

}  // namespace

void Catalogue::add(StageEntry entry) {
  for (const StageEntry& other : entries_) {
    if (other.kind != entry.kind) continue;
    if (other.name == entry.name) {
      throw std::logic_error("two stages " + entry.kind + "/" + entry.name);
    }
    if (other.kind_summary != entry.kind_summary || other.kind_order != entry.kind_order) {
      throw std::logic_error("two kinds of stages are called " + entry.kind);
    }
  }
  const auto next = std::upper_bound(entries_.begin(), entries_.end(), entry, comes_before);
  entries_.insert(next, std::move(entry));
}

std::vector<StageKind> Catalogue::kinds() const {
  std::vector<StageKind> kinds;
  for (const StageEntry& entry : entries_) {
    if (!kinds.empty() && kinds.back().name == entry.kind) continue;
    kinds.push_back({entry.kind, entry.kind_summary, entry.kind_order});
  }
  return kinds;
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
  const SlotBuilder slots(*this);
  params::BuiltStage built = entry->build(node, slots);
  if (!built.flow) built.flow = slots.flow();
  built.versions = slots.versions();
  built.versions[kind + "/" + name] = entry->version;
  return built;
}

}  // namespace croon
