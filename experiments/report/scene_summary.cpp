#include "experiments/report/scene_summary.hpp"

#include <cmath>
#include <utility>

#include "framework/base/angles.hpp"

namespace croon::experiments {

namespace {

/// The values of measure `k`.
std::vector<double> column(const std::vector<Measures>& rows, std::size_t k) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Measures& row : rows) values.push_back(row[k]);
  return values;
}

MeasureStatistics statistics_of(const std::vector<double>& values) {
  std::vector<double> magnitudes;
  magnitudes.reserve(values.size());
  for (const double value : values) magnitudes.push_back(std::abs(value));
  return {mean(values), standard_deviation(values), median(values), root_mean_square(values),
          percentile(std::move(magnitudes), 0.95)};
}

Outcomes count_outcomes(const SceneRecords& records) {
  Outcomes outcomes;
  outcomes.trials = static_cast<int>(records.size());
  for (const TrialRecord* record : records) {
    outcomes.success += record->status == Status::success;
    outcomes.inaccurate += record->status == Status::inaccurate;
    outcomes.rejected += record->status == Status::rejected;
    outcomes.failed += record->status == Status::failed;
  }
  return outcomes;
}

bool has_good_pose(const TrialRecord& record) {
  return record.status == Status::success && record.T_reference_sensor;
}

}  // namespace

PoseBounds pose_bounds(const SuccessBounds& bounds) {
  return {rad_from_deg(bounds.rotation_deg), bounds.translation_m};
}

Share share_of(int count, int trials) {
  const double ratio = trials == 0 ? 0.0 : static_cast<double>(count) / trials;
  return {count, trials, ratio, wilson_interval(count, trials)};
}

const RigidTransform* usable_pose(const TrialRecord& record) {
  const bool is_usable = record.status == Status::success || record.status == Status::inaccurate;
  return is_usable && record.T_reference_sensor ? &*record.T_reference_sensor : nullptr;
}

void add_outcomes(Outcomes& sum, const Outcomes& outcomes) {
  sum.trials += outcomes.trials;
  sum.success += outcomes.success;
  sum.inaccurate += outcomes.inaccurate;
  sum.rejected += outcomes.rejected;
  sum.failed += outcomes.failed;
}

StatisticsTable statistics_of(const std::vector<Measures>& deviations) {
  StatisticsTable table;
  for (std::size_t k = 0; k < table.size(); ++k) table[k] = statistics_of(column(deviations, k));
  return table;
}

SceneSummary start_scene_summary(const SceneRecords& records, const PoseBounds& bounds) {
  SceneSummary scene;
  scene.scene = records.front()->id.scene;
  scene.outcomes = count_outcomes(records);
  scene.success = share_of(scene.outcomes.success, scene.outcomes.trials);
  std::vector<RigidTransform> poses;
  for (const TrialRecord* record : records) {
    if (has_good_pose(*record)) poses.push_back(*record->T_reference_sensor);
  }
  int agreeing = 0;
  if (!poses.empty()) {
    scene.consensus = consensus_pose(poses, bounds);
    for (const RigidTransform& pose : poses) agreeing += agree(pose, *scene.consensus, bounds);
  }
  scene.agreement = share_of(agreeing, scene.outcomes.trials);
  return scene;
}

void add_deviations(SceneSummary& scene, const SceneRecords& records, Reference reference,
                    const std::optional<RigidTransform>& consensus, const PoseBounds& bounds) {
  for (const TrialRecord* record : records) {
    if (!has_good_pose(*record)) continue;
    const RigidTransform& pose = *record->T_reference_sensor;
    if (reference == Reference::truth) {
      if (!record->error) continue;
      scene.deviations.push_back(measures_of(*record->error));
    } else {
      if (!agree(pose, *scene.consensus, bounds)) continue;
      scene.deviations.push_back(measures_of(pose_error(pose, *consensus)));
    }
    scene.spread.push_back(measures_of(pose_error(pose, *scene.consensus)));
  }
  scene.counted = static_cast<int>(scene.deviations.size());
  if (scene.counted > 0) scene.statistics = statistics_of(scene.deviations);
}

std::optional<std::array<double, kDofs>> within_scene_std(const std::vector<SceneSummary>& scenes) {
  double freedom = 0.0;
  std::array<std::vector<double>, kDofs> squares;
  for (const SceneSummary& scene : scenes) {
    if (scene.counted < 2) continue;
    freedom += scene.counted - 1;
    for (std::size_t k = 0; k < kDofs; ++k) {
      const double std = standard_deviation(column(scene.spread, k));
      squares[k].push_back(std * std * (scene.counted - 1));
    }
  }
  if (freedom == 0.0) return std::nullopt;
  std::array<double, kDofs> pooled;
  for (std::size_t k = 0; k < kDofs; ++k) {
    pooled[k] = std::sqrt(compensated_sum(squares[k]) / freedom);
  }
  return pooled;
}

std::optional<std::array<double, kDofs>> across_scenes_std(const SummaryRow& row) {
  std::vector<Measures> centres;
  for (const SceneSummary& scene : row.scenes) {
    if (!scene.statistics) continue;
    if (row.reference == Reference::consensus) {
      centres.push_back(measures_of(pose_error(*scene.consensus, *row.consensus)));
      continue;
    }
    Measures means;
    for (std::size_t k = 0; k < means.size(); ++k) means[k] = (*scene.statistics)[k].mean;
    centres.push_back(means);
  }
  if (centres.size() < 2) return std::nullopt;
  std::array<double, kDofs> spread;
  for (std::size_t k = 0; k < kDofs; ++k) spread[k] = standard_deviation(column(centres, k));
  return spread;
}

}  // namespace croon::experiments
