#pragma once

#include <string>
#include <vector>

#include "framework/stage/stage_entry.hpp"

namespace croon {

/// The stages that exist, and how to build them from JSON. Plain data, filled once; a test may fill
/// its own.
class Catalogue final : public params::StageBuilder {
 public:
  /// Adds a stage. A second stage of the same kind and name is a std::logic_error, and so is a
  /// second description of a kind.
  void add(StageEntry entry);

  /// The kinds that have a stage, in their order, kinds of equal order by name.
  std::vector<StageKind> kinds() const;
  /// All entries, in the order of kinds() and then by name.
  const std::vector<StageEntry>& entries() const { return entries_; }
  /// The entry, or null.
  const StageEntry* find(const std::string& kind, const std::string& name) const;
  /// The names of a kind's stages.
  std::vector<std::string> names(const std::string& kind) const;

  /// The stage that `node` describes. Faults (not an object, no such stage, wrong parameters) are
  /// noted in the node.
  params::BuiltStage build(const std::string& kind, const params::Node& node) const override;

  /// The same, as a slot of the kind `Kind`.
  template <class Kind>
  params::Slot<Kind> slot(const params::Node& node) const {
    return params::Slot<Kind>(build(Kind::kKind, node));
  }

 private:
  std::vector<StageEntry> entries_;
};

}  // namespace croon
