#include "experiments/report/figures.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The order of the reports that `summary` was computed for.
ReportOrder order_of(const Summary& summary) {
  ReportOrder order;
  order.variants = variants_of(summary);
  order.sensors = sensors_of(summary);
  for (const LoopClosure& loop : summary.loops) {
    const auto is_same = [&](const SensorPair& pair) { return pair.name == loop.pair.name; };
    if (std::none_of(order.pairs.begin(), order.pairs.end(), is_same)) {
      order.pairs.push_back(loop.pair);
    }
  }
  std::set<std::string> seen;
  for (const SummaryRow& row : summary.rows) {
    if (lacks_truth(row)) order.without_truth.insert(row.sensor);
    for (const SceneSummary& scene : row.scenes) {
      if (!scene.scene_kind.empty()) order.scene_kinds[scene.scene] = scene.scene_kind;
      if (seen.insert(scene.scene).second) order.scenes.push_back(scene.scene);
    }
  }
  return order;
}

/// The chosen `names`, in the order of `all`; all if no names are given. Throws InputError for a
/// name that is not in `all`.
Names chosen(const std::string& option, const Names& names, const Names& all) {
  refuse_unknown(option, names, all);
  if (names.empty()) return all;
  Names left;
  for (const std::string& name : all) {
    if (contains(names, name)) left.push_back(name);
  }
  return left;
}

}  // namespace

const std::vector<Figure>& figures() {
  static const std::vector<Figure> figures = {
      {"basin",
       [](const Results& results, const FigureOptions& options) -> std::optional<Drawing> {
         if (!results.basin) return std::nullopt;
         return basin_chart(*results.basin, options);
       },
       "a sweep of starts and ground truth"},
      {"box_plots",
       [](const Results& results, const FigureOptions& options) -> std::optional<Drawing> {
         return box_plots(results.summary, options);
       },
       ""},
      {"coverage",
       [](const Results& results, const FigureOptions& options) -> std::optional<Drawing> {
         if (results.coverage.rows.empty()) return std::nullopt;
         return coverage_chart(results.coverage, options);
       },
       "covariances and a dataset with ground truth"},
      {"kinds",
       [](const Results& results, const FigureOptions& options) -> std::optional<Drawing> {
         if (results.summary.scene_kinds.empty()) return std::nullopt;
         return kinds_chart(results.summary, options);
       },
       "a dataset with kinds of scenes"},
      {"success_curve",
       [](const Results& results, const FigureOptions& options) -> std::optional<Drawing> {
         if (results.summary.curve.rows.empty()) return std::nullopt;
         return success_curve_chart(results.summary.curve, options);
       },
       "a dataset with ground truth"},
      {"times",
       [](const Results& results, const FigureOptions& options) -> std::optional<Drawing> {
         if (results.times.empty()) return std::nullopt;
         return times_chart(results.times, options);
       },
       "wall times (timings.sqlite)", true},
      {"verdicts",
       [](const Results& results, const FigureOptions& options) -> std::optional<Drawing> {
         if (!has_curve(results.acceptance)) return std::nullopt;
         return acceptance_chart(results.acceptance, results.summary.bounds, options);
       },
       "a step that rejects trials, and a dataset with ground truth"}};
  return figures;
}

const std::vector<NamedSheet>& named_sheets() {
  static const std::vector<NamedSheet> sheets = {
      {"one_column", kOneColumn}, {"two_columns", kTwoColumns}, {"screen", Sheet{}}};
  return sheets;
}

Results restricted(Results results, const TrialChoice& choice) {
  if (choice.variants.empty() && choice.sensors.empty() && choice.kinds.empty()) {
    return results;
  }
  ReportOrder order = order_of(results.summary);
  std::set<std::string> kinds;
  for (const auto& [scene, kind] : order.scene_kinds) kinds.insert(kind);
  refuse_unknown("--kinds", choice.kinds, {kinds.begin(), kinds.end()});
  order.variants = chosen("--variants", choice.variants, order.variants);
  order.sensors = chosen("--sensors", choice.sensors, order.sensors);
  if (!choice.kinds.empty()) {
    Names scenes;
    for (const std::string& scene : order.scenes) {
      const auto kind = order.scene_kinds.find(scene);
      const bool is_chosen =
          kind != order.scene_kinds.end() && contains(choice.kinds, kind->second);
      if (is_chosen) scenes.push_back(scene);
    }
    order.scenes = scenes;
  }
  const bool is_whole = results.records.size() == results.planned;
  const auto is_chosen = [&](const TrialId& id) {
    return contains(order.variants, id.variant) && contains(order.sensors, id.sensor) &&
           contains(order.scenes, id.scene);
  };
  std::vector<TrialRecord> records;
  std::vector<std::optional<std::uint32_t>> new_index(results.records.size());
  for (std::size_t i = 0; i < results.records.size(); ++i) {
    if (!is_chosen(results.records[i].id)) continue;
    new_index[i] = static_cast<std::uint32_t>(records.size());
    records.push_back(std::move(results.records[i]));
  }
  results.records = std::move(records);
  std::vector<StepNumber> numbers;
  for (StepNumber number : results.steps.numbers) {
    if (!new_index[number.record]) continue;
    number.record = *new_index[number.record];
    numbers.push_back(number);
  }
  results.steps.numbers = std::move(numbers);
  results.diagnostics = summarise_diagnostics(results.records, results.steps);
  results.scenes = std::min(results.scenes, order.scenes.size());
  // Some scenes may lack sensors.
  results.planned = is_whole ? results.records.size()
                             : order.variants.size() * order.sensors.size() * order.scenes.size() *
                                   static_cast<std::size_t>(results.trials);
  results.summary = summarise(results.records, results.summary.bounds, order);
  results.acceptance = acceptance_of(results.records, results.summary);
  results.coverage = coverage_of(results.records, results.summary);
  std::vector<Claim> claims;
  for (const ClaimResult& result : results.claims) claims.push_back(result.claim);
  results.claims = check_claims(claims, results.summary);
  if (results.basin) results.basin = basin_of(results.records, results.basin->sweep, order);
  return results;
}

void refuse_unknown(const std::string& option, const Names& names, const Names& known) {
  for (const std::string& name : names) {
    if (contains(known, name)) continue;
    throw InputError("", option,
                     "unknown name \"" + name + "\"" +
                         (known.empty() ? "; these results have none" : name_hint(name, known)));
  }
}

}  // namespace croon::experiments
