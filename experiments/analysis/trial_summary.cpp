#include "experiments/analysis/trial_summary.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/base/angles.hpp"

namespace croon::experiments {

Share share_of(int count, int trials) {
  const double ratio = trials == 0 ? 0.0 : static_cast<double>(count) / trials;
  return {count, trials, ratio, wilson_interval(count, trials)};
}

std::vector<double> values_of(const std::vector<Measures>& rows, std::size_t measure) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Measures& row : rows) values.push_back(row[measure]);
  return values;
}

StatisticsTable statistics_of(const std::vector<Measures>& deviations) {
  StatisticsTable table;
  for (std::size_t k = 0; k < table.size(); ++k) table[k] = statistics_of(values_of(deviations, k));
  return table;
}

std::optional<double> value_of(const std::optional<StatisticsTable>& table, std::size_t measure,
                               std::size_t statistic) {
  if (!table || std::isnan((*table)[measure][statistic])) return std::nullopt;
  return (*table)[measure][statistic];
}

const char* name_of(DeviationsFrom from) {
  switch (from) {
    case DeviationsFrom::truth:
      return "truth";
    case DeviationsFrom::consensus:
      return "consensus";
    case DeviationsFrom::none:
      return "none";
  }
  throw std::logic_error("deviations from a pose that does not exist");
}

const Share& main_share(const TrialSummary& summary) {
  return summary.deviations_from == DeviationsFrom::consensus ? summary.agreement : summary.success;
}

TrialSummary pooled(const std::vector<const SceneSummary*>& scenes) {
  TrialSummary sum;
  int agreeing = 0;
  std::vector<Measures> deviations;
  for (const SceneSummary* scene : scenes) {
    sum.deviations_from = std::min(sum.deviations_from, scene->deviations_from);
    sum.outcomes.trials += scene->outcomes.trials;
    sum.outcomes.success += scene->outcomes.success;
    sum.outcomes.inaccurate += scene->outcomes.inaccurate;
    sum.outcomes.rejected += scene->outcomes.rejected;
    sum.outcomes.failed += scene->outcomes.failed;
    agreeing += scene->agreement.count;
    deviations.insert(deviations.end(), scene->deviations.begin(), scene->deviations.end());
  }
  sum.success = share_of(sum.outcomes.success, sum.outcomes.trials);
  sum.agreement = share_of(agreeing, sum.outcomes.trials);
  sum.counted = static_cast<int>(deviations.size());
  if (sum.counted > 0) sum.statistics = statistics_of(deviations);
  return sum;
}

std::vector<const SceneSummary*> scenes_of(const std::vector<const SummaryRow*>& rows) {
  std::vector<const SceneSummary*> scenes;
  for (const SummaryRow* row : rows) {
    for (const SceneSummary& scene : row->scenes) scenes.push_back(&scene);
  }
  return scenes;
}

PoseBounds pose_bounds(const SuccessBounds& bounds) {
  return {rad_from_deg(bounds.rotation_deg), bounds.translation_m};
}

const RigidTransform* usable_pose(const TrialRecord& record) {
  const bool is_usable = record.status == Status::success || record.status == Status::inaccurate;
  return is_usable && record.T_reference_sensor ? &*record.T_reference_sensor : nullptr;
}

}  // namespace croon::experiments
