#include <cmath>

#include "experiments/analysis/trial_summary.hpp"

namespace croon::experiments {

namespace {

constexpr std::size_t kMean = statistic_index("mean");

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

/// The outcomes of a scene and the pose that its successful trials agree on: all but the
/// deviations.
SceneSummary without_deviations(const SceneRecords& records, const PoseBounds& bounds) {
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

/// Adds the deviations of the trials that count (see `SummaryRow`) from the truth or from
/// `consensus`, that of all scenes.
void add_deviations(SceneSummary& scene, const SceneRecords& records,
                    const std::optional<RigidTransform>& consensus, const PoseBounds& bounds) {
  for (const TrialRecord* record : records) {
    if (!has_good_pose(*record)) continue;
    const RigidTransform& pose = *record->T_reference_sensor;
    if (scene.deviations_from == DeviationsFrom::truth) {
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

/// Truth if one trial has it, else the consensus of the scenes.
DeviationsFrom deviations_from(const std::vector<SceneRecords>& scenes, bool has_consensus) {
  for (const SceneRecords& scene : scenes) {
    for (const TrialRecord* record : scene) {
      if (record->error) return DeviationsFrom::truth;
    }
  }
  return has_consensus ? DeviationsFrom::consensus : DeviationsFrom::none;
}

/// See `SummaryRow::within_scene_std`.
std::optional<DofValues> within_scene_std(const std::vector<SceneSummary>& scenes) {
  double freedom = 0.0;
  std::array<std::vector<double>, kDofs> squares;
  for (const SceneSummary& scene : scenes) {
    if (scene.counted < 2) continue;
    freedom += scene.counted - 1;
    for (std::size_t k = 0; k < kDofs; ++k) {
      const double std = standard_deviation(values_of(scene.spread, k));
      squares[k].push_back(std * std * (scene.counted - 1));
    }
  }
  if (freedom == 0.0) return std::nullopt;
  DofValues spread;
  for (std::size_t k = 0; k < kDofs; ++k) {
    spread[k] = std::sqrt(compensated_sum(squares[k]) / freedom);
  }
  return spread;
}

/// See `SummaryRow::across_scenes_std`; the scenes and the consensus of `row` are complete.
std::optional<DofValues> across_scenes_std(const SummaryRow& row) {
  std::vector<Measures> centres;
  for (const SceneSummary& scene : row.scenes) {
    if (!scene.statistics) continue;
    if (row.deviations_from == DeviationsFrom::consensus) {
      centres.push_back(measures_of(pose_error(*scene.consensus, *row.consensus)));
      continue;
    }
    Measures means;
    for (std::size_t k = 0; k < means.size(); ++k) means[k] = (*scene.statistics)[k][kMean];
    centres.push_back(means);
  }
  if (centres.size() < 2) return std::nullopt;
  DofValues spread;
  for (std::size_t k = 0; k < kDofs; ++k) spread[k] = standard_deviation(values_of(centres, k));
  return spread;
}

}  // namespace

SummaryRow summary_row(const std::vector<SceneRecords>& scenes, const PoseBounds& bounds) {
  SummaryRow row;
  row.variant = scenes.front().front()->id.variant;
  row.sensor = scenes.front().front()->id.sensor;
  std::vector<RigidTransform> consensus;
  for (const SceneRecords& records : scenes) {
    row.scenes.push_back(without_deviations(records, bounds));
    if (row.scenes.back().consensus) consensus.push_back(*row.scenes.back().consensus);
  }
  if (!consensus.empty()) row.consensus = consensus_pose(consensus, bounds);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    row.scenes[i].deviations_from = deviations_from(scenes, row.consensus.has_value());
    add_deviations(row.scenes[i], scenes[i], row.consensus, bounds);
  }
  static_cast<TrialSummary&>(row) = pooled(scenes_of({&row}));
  row.within_scene_std = within_scene_std(row.scenes);
  row.across_scenes_std = across_scenes_std(row);
  return row;
}

}  // namespace croon::experiments
