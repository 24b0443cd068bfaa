#pragma once

#include "framework/params/slot.hpp"

namespace croon::params {

/// Builds no stage: for tables of which no parameter is one.
struct NoStages final : StageBuilder {
  BuiltStage build(const std::string&, const Node&) const override { return {}; }
};

}  // namespace croon::params
