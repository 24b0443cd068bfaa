#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/results.hpp"
#include "experiments/report/plots.hpp"

namespace croon::experiments {

/// A figure of `croon export`.
struct Figure {
  const char* name;
  /// std::nullopt if these results lack what the figure requires.
  std::optional<Drawing> (*draw)(const Results& results, const FigureOptions& options);
  const char* requirement;  ///< What results need for this figure, in words.
  bool has_times = false;   ///< Whether it shows Results::times.
};

/// All figures, by name. A new figure is a row here.
const std::vector<Figure>& figures();

/// A named width of figures and tables.
struct NamedSheet {
  const char* name;
  Sheet sheet;
};

/// The widths by name: the columns of a paper, and unlimited width for a screen.
const std::vector<NamedSheet>& named_sheets();

/// The variants, sensors and kinds of scenes to include; an empty list means all.
struct TrialChoice {
  std::vector<std::string> variants;
  std::vector<std::string> sensors;
  std::vector<std::string> kinds;
};

/// The results restricted to the chosen trials: everything computed from trials is recomputed, and
/// comparisons are with the first of the chosen variants. Throws InputError for unknown names.
Results restricted(Results results, const TrialChoice& choice);

/// Throws InputError, with the nearest known name, if one of `names`, the values of `option`, is
/// not in `known`.
void refuse_unknown(const std::string& option, const std::vector<std::string>& names,
                    const std::vector<std::string>& known);

}  // namespace croon::experiments
