#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

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

/// For tables without stages.
class NoStages final : public StageBuilder {
 public:
  BuiltStage build(const std::string& kind, const Node&) const override {
    throw std::logic_error("expected no stage, found one of the kind " + kind);
  }
};

/// A parameter whose value is a stage of the kind `Kind`.
template <class Kind>
class Slot {
 public:
  Slot() = default;
  explicit Slot(BuiltStage built) : built_(std::move(built)) {
    if (!built_.flow) built_.flow.emplace();
  }

  const Kind* operator->() const { return static_cast<const Kind*>(built_.stage.get()); }
  const Kind& operator*() const { return *operator->(); }
  /// The stage's name, "ransac".
  const std::string& name() const { return built_.name; }
  /// Canonical JSON text of the stage and its parameters: the cache key for what it computes once
  /// per cloud.
  const std::string& resolved() const { return built_.resolved; }
  /// The versions of the stage and of those in its own slots.
  const StageVersions& versions() const { return built_.versions; }
  /// The data flow of the stage and of those in its slots.
  const DataFlow& flow() const { return *built_.flow; }

 private:
  BuiltStage built_ = {nullptr, "", "", {}, DataFlow()};
};

}  // namespace croon::params
