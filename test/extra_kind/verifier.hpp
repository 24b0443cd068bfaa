#pragma once

#include <optional>
#include <string>

#include "framework/stage/step.hpp"

namespace croon {

/// Decides whether an estimate is to be trusted.
class Verifier {
 public:
  using Kind = Verifier;
  static constexpr const char* kKind = "verifier";
  static constexpr const char* kKindSummary = "Decides whether an estimate is to be trusted.";
  static constexpr int kKindOrder = 75;
  virtual ~Verifier() = default;

  /// Why the estimate is not to be trusted; std::nullopt if it is.
  virtual std::optional<std::string> objection(const Estimate& estimate) const = 0;
};

}  // namespace croon
