#pragma once

#include <optional>

#include "experiments/file/expectation.hpp"

namespace croon::experiments {

/// Whether a number lies in its band.
enum class Verdict {
  in,
  out,
  not_measured  ///< The run has no such variant or sensor, or nothing that counts.
};

/// An expectation, and what a run came to.
struct ClaimResult {
  Expectation expectation;
  std::optional<double> found;  ///< In the unit of the expectation.
  Verdict verdict = Verdict::not_measured;
};

}  // namespace croon::experiments
