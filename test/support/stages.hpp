#pragma once

#include <stdexcept>
#include <string>

#include "framework/params/json_file.hpp"
#include "registry/registry.hpp"

namespace croon::test {

/// The stage that `json` describes, built as an experiment builds it. Throws InputError.
params::BuiltStage build_stage(const std::string& kind, const std::string& json);

/// The same, typed: `stage<Icp>(R"({"type": "icpn"})")`.
template <class Kind>
params::Slot<Kind> stage(const std::string& json) {
  return params::Slot<Kind>(build_stage(Kind::kKind, json));
}

}  // namespace croon::test
