#pragma once

#include <optional>

#include "experiments/file/claims.hpp"

namespace croon::experiments {

/// Whether a number lies in its band.
enum class Verdict {
  in,
  out,
  not_measured  ///< The run has no such variant or sensor, or nothing that counts.
};

/// A claim, and what a run came to.
struct ClaimResult {
  Claim claim;
  std::optional<double> found;  ///< In the unit of the claim.
  Verdict verdict = Verdict::not_measured;
};

}  // namespace croon::experiments
