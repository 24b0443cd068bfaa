#pragma once

#include <string>
#include <vector>

#include "framework/stage/stage_entry.hpp"

namespace croon {

/// All known stages, and how to build them from JSON. Plain data, filled once; a test may fill its
/// own.
class Catalogue final : public params::StageBuilder {
 public:
  /// Adds a stage. Throws std::logic_error for a duplicate kind and name, and for a second
  /// description of a kind.
  void add(StageEntry entry);

  /// The kinds that have a stage, by their order number, then by name.
  std::vector<StageKind> kinds() const;
  /// All entries, in the order of kinds() and then by name.
  const std::vector<StageEntry>& entries() const { return entries_; }
  /// The entry, or null.
  const StageEntry* find(const std::string& kind, const std::string& name) const;
  /// The names of a kind's stages.
  std::vector<std::string> names(const std::string& kind) const;

  /// Builds the stage that `node` describes. Notes faults (not an object, unknown stage, invalid
  /// parameters) in the node.
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
