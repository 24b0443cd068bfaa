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
  /// std::nullopt if these results have no such figure.
  std::optional<Drawing> (*draw)(const Results& results, const FigureOptions& options);
  const char* requirement;  ///< What results must have for it.
};

/// All figures, by name. A new one is a row here.
const std::vector<Figure>& figures();

/// A width of figures and tables.
struct NamedSheet {
  const char* name;
  Sheet sheet;
};

/// The widths by name: the columns of a paper, and as wide as a screen needs.
const std::vector<NamedSheet>& named_sheets();

/// The variants, sensors and kinds of scenes to look at; those of an empty list are all.
struct TrialChoice {
  std::vector<std::string> variants;
  std::vector<std::string> sensors;
  std::vector<std::string> kinds;
};

/// The results as if there were no other trials: all that is computed from trials is computed
/// again, and comparisons are with the first of the variants. Throws InputError for a name that the
/// results lack.
Results restricted(Results results, const TrialChoice& choice);

/// Throws InputError, with the nearest known name, if one of `names`, the values of `option`, is
/// not `known`.
void refuse_unknown(const std::string& option, const std::vector<std::string>& names,
                    const std::vector<std::string>& known);

}  // namespace croon::experiments
