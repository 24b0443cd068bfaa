#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/trial_summary.hpp"

namespace croon::experiments {

// Bands around the lines of a figure: the intervals of shares.

/// The intervals of shares; std::nullopt for a share without an interval.
std::vector<std::optional<Interval>> intervals_of(const std::vector<Share>& shares);

/// Indices of the lines drawn with a band: all of `lines` if there are at most four, otherwise only
/// the first, because more overlapping bands would hide the lines.
std::vector<std::size_t> lines_with_band(std::size_t lines);

/// Describes the bands of the lines `with_band`; `names` are the names of all lines.
std::string band_sentence(const std::vector<std::string>& names,
                          const std::vector<std::size_t>& with_band);

}  // namespace croon::experiments
