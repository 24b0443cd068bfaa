#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "framework/params/data_flow.hpp"
#include "framework/params/node.hpp"

namespace croon::params {

/// The versions of stages by kind and name: {"icp/icpn", 1}.
using StageVersions = std::map<std::string, int>;

/// A stage that was built from JSON, with the JSON that builds it again: all its parameters,
/// defaults too, keys in order. Two slots with the same `resolved` text compute the same.
struct BuiltStage {
  std::shared_ptr<const void> stage;  ///< Points at the stage's kind; null if there were faults.
  std::string name;                   ///< "ransac".
  std::string resolved;
  StageVersions versions = {};  ///< Of the stage and of those in its slots.
  /// What the stage and those in its slots need and provide.
  std::optional<DataFlow> flow = {};
};

/// Builds the stages that a parameter table holds. The catalogue of stages is one; params knows no
/// stage.
class StageBuilder {
 public:
  virtual ~StageBuilder() = default;
  /// The stage of `kind` that `node` describes. Notes faults in the node and then returns a null
  /// stage.
  virtual BuiltStage build(const std::string& kind, const Node& node) const = 0;
};

/// A parameter that holds a stage of the kind `Kind`.
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
  /// Canonical JSON text of the stage and its parameters: the key of what it computes once per
  /// cloud.
  const std::string& resolved() const { return resolved_; }
  /// The versions of the stage and of those in its slots.
  const StageVersions& versions() const { return versions_; }
  /// What the stage and those in its slots need and provide.
  const DataFlow& flow() const { return flow_; }

 private:
  std::shared_ptr<const Kind> stage_;
  std::string name_;
  std::string resolved_;
  StageVersions versions_;
  DataFlow flow_;
};

}  // namespace croon::params
