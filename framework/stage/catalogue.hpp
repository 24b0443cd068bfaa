#pragma once

#include <string>
#include <vector>

#include "framework/stage/stage_entry.hpp"

namespace croon {

/// The kinds of stages, in the order in which they take part in a calibration.
const std::vector<std::string>& stage_kinds();

/// The stages that exist, and how to build them from JSON. Plain data, filled once; a test may fill
/// its own.
class Catalogue final : public params::StageBuilder {
 public:
  /// Adds a stage; a second one of the same kind and name, or an unknown kind, is a
  /// std::logic_error.
  void add(StageEntry entry);

  /// All entries, by kind and then by name.
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
