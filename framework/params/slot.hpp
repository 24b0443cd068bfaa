#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "framework/params/data_flow.hpp"
#include "framework/params/node.hpp"

namespace croon::params {

/// The versions of stages by kind and name, e.g. {"icp/icpn", 1}.
using StageVersions = std::map<std::string, int>;

/// A stage built from JSON, with the canonical JSON that builds it again: all its parameters,
/// including defaults, keys in order. Two slots with the same `resolved` text compute the same.
struct BuiltStage {
  std::shared_ptr<const void> stage;  ///< Points to the stage's kind; null if there were faults.
  std::string name;                   ///< "ransac".
  std::string resolved;
  StageVersions versions = {};  ///< Of the stage and of those in its own slots.
  /// The data flow of the stage and of those in its slots.
  std::optional<DataFlow> flow = {};
};

/// Builds the stages that are values in a parameter table. The catalogue of stages implements it,
/// so that params depends on no stage.
class StageBuilder {
 public:
  virtual ~StageBuilder() = default;
  /// Builds the stage of `kind` that `node` describes. Notes faults in the node and then returns a
  /// null stage.
  virtual BuiltStage build(const std::string& kind, const Node& node) const = 0;
};

/// A parameter whose value is a stage of the kind `Kind`.
template <class Kind>
class Slot {
 public:
  Slot() = default;
  explicit Slot(const BuiltStage& built)
      : stage_(std::static_pointer_cast<const Kind>(built.stage)),
        name_(built.name),
        resolved_(built.resolved),
        versions_(built.versions),
        flow_(built.flow.value_or(DataFlow())) {}

  const Kind* operator->() const { return stage_.get(); }
  const Kind& operator*() const { return *stage_; }
  /// The stage's name, "ransac".
  const std::string& name() const { return name_; }
  /// Canonical JSON text of the stage and its parameters: the cache key for what it computes once
  /// per cloud.
  const std::string& resolved() const { return resolved_; }
  /// The versions of the stage and of those in its own slots.
  const StageVersions& versions() const { return versions_; }
  /// The data flow of the stage and of those in its slots.
  const DataFlow& flow() const { return flow_; }

 private:
  std::shared_ptr<const Kind> stage_;
  std::string name_;
  std::string resolved_;
  StageVersions versions_;
  DataFlow flow_;
};

}  // namespace croon::params
