#include "experiments/analysis/diagnostics.hpp"

#include <cmath>
#include <map>
#include <tuple>

#include "framework/base/statistics.hpp"

namespace croon::experiments {

std::vector<DiagnosticSummary> summarise_diagnostics(const std::vector<TrialRecord>& records,
                                                     const StepNumbers& steps) {
  // Records are ordered by variant, so summaries are in order of first appearance.
  std::map<std::tuple<std::string, std::uint32_t, std::uint32_t>, std::size_t> indices;
  std::vector<DiagnosticSummary> summaries;
  std::vector<std::vector<double>> finite;
  for (const StepNumber& number : steps.numbers) {
    const std::string& variant = records[number.record].id.variant;
    const auto [entry, is_new] =
        indices.emplace(std::tuple(variant, number.step, number.name), summaries.size());
    if (is_new) {
      summaries.push_back(
          {variant, steps.names[number.step], steps.names[number.name], 0, std::nullopt});
      finite.emplace_back();
    }
    ++summaries[entry->second].trials;
    if (std::isfinite(number.value)) finite[entry->second].push_back(number.value);
  }
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    if (!finite[i].empty()) summaries[i].median = median(std::move(finite[i]));
  }
  return summaries;
}

}  // namespace croon::experiments
