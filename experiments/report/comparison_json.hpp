#pragma once

#include <nlohmann/json_fwd.hpp>

#include "experiments/report/comparison.hpp"

namespace croon::experiments {

/// An element of "comparisons" in summary.json. JSON has no infinite numbers: they are the texts
/// "inf" and "-inf".
nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace croon::experiments
