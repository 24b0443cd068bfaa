#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/trial_summary.hpp"

namespace croon::experiments {

// The bands about the lines of a figure: the intervals of shares.

/// The intervals of shares; std::nullopt for a share that has none.
std::vector<std::optional<Interval>> intervals_of(const std::vector<Share>& shares);

/// The lines that have a band: all of `lines` up to four, else the first alone. More bands, which
/// overlap, would hide the lines.
std::vector<std::size_t> lines_with_band(std::size_t lines);

/// What the bands are, of those `with_band` of the lines called `names`.
std::string band_sentence(const std::vector<std::string>& names,
                          const std::vector<std::size_t>& with_band);

}  // namespace croon::experiments
