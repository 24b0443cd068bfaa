#include "experiments/analysis/trial_summary.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "framework/base/angles.hpp"

namespace croon::experiments {
namespace {

constexpr std::size_t kMean = statistic_index("mean");

/// The numbers of trials by status, in the order of Status.
constexpr std::array kByStatus = {&Outcomes::success, &Outcomes::inaccurate, &Outcomes::finished,
                                  &Outcomes::rejected, &Outcomes::failed};

/// Whether the usable pose of a trial is within `bounds` of `pose`; std::nullopt without a usable
/// pose.
std::optional<bool> is_near(const TrialRecord& record, const RigidTransform& pose,
                            const PoseBounds& bounds) {
  const RigidTransform* const usable = usable_pose(record);
  if (usable == nullptr) return std::nullopt;
  return agree(*usable, pose, bounds);
}

/// The trials of `records` that are near `pose`; `is_alone` means that there is no other trial.
Agreeing agreeing_with(const RigidTransform& pose, const SceneRecords& records,
                       const PoseBounds& bounds, bool is_alone) {
  std::vector<double> rotations, translations;
  for (const TrialRecord* record : records) {
    if (!is_near(*record, pose, bounds).value_or(false)) continue;
    const Measures distances = measures_of(pose_error(*record->T_reference_sensor, pose));
    rotations.push_back(distances[kRotation]);
    translations.push_back(distances[kTranslation]);
  }
  // A pose that is near no pose but itself does not agree with any.
  if (rotations.empty() || (rotations.size() == 1 && !is_alone)) return {};
  return {static_cast<int>(rotations.size()), root_mean_square(rotations),
          root_mean_square(translations)};
}

/// The covariances of the poses that agree on a consensus; std::nullopt if any of them is unknown.
std::optional<std::vector<PoseCovariance>> covariances_of_members(
    const std::vector<RigidTransform>& poses,
    const std::vector<std::optional<PoseCovariance>>& covariances, const PoseBounds& bounds,
    const std::vector<double>& votes = {}) {
  const auto is_known = [](const std::optional<PoseCovariance>& one) { return one.has_value(); };
  // Finding the members takes as long as the consensus.
  if (std::none_of(covariances.begin(), covariances.end(), is_known)) return std::nullopt;
  std::vector<PoseCovariance> members;
  for (const std::size_t i : consensus_members(poses, bounds, votes)) {
    if (!covariances[i]) return std::nullopt;
    members.push_back(*covariances[i]);
  }
  return members;
}

/// The outcomes of a scene and its consensus: everything that does not depend on other scenes.
SceneSummary without_deviations(const SceneRecords& records, const PoseBounds& bounds) {
  SceneSummary scene;
  scene.scene = records.front()->id.scene;
  std::vector<RigidTransform> poses;
  std::vector<std::optional<PoseCovariance>> covariances;
  for (const TrialRecord* record : records) {
    ++scene.outcomes.trials;
    ++(scene.outcomes.*kByStatus.at(static_cast<std::size_t>(record->status)));
    if (record->T_reference_sensor) {
      const auto from = record->error ? DeviationsFrom::truth : DeviationsFrom::consensus;
      scene.deviations_from = std::min(scene.deviations_from, from);
    }
    if (const RigidTransform* pose = usable_pose(*record)) {
      poses.push_back(*pose);
      covariances.push_back(record->covariance);
    }
  }
  if (poses.empty()) return scene;
  scene.consensus = consensus_pose(poses, bounds);
  scene.agreeing = agreeing_with(*scene.consensus, records, bounds, records.size() == 1);
  const auto members = covariances_of_members(poses, covariances, bounds);
  if (members) scene.covariance = mean_covariance(*members);
  return scene;
}

/// Whether the trial is counted (see `SummaryRow`).
bool counts(const TrialRecord& record, const SceneSummary& scene, const PoseBounds& bounds) {
  if (lacks_truth(scene)) {
    const bool is_alone = scene.outcomes.trials == 1 && usable_pose(record) != nullptr;
    return agrees(record, scene, bounds).value_or(is_alone);
  }
  return record.status == Status::success && record.error;
}

/// Adds the deviations of the counted trials from ground truth or from `consensus`, that of all
/// scenes.
void add_deviations(SceneSummary& scene, const SceneRecords& records,
                    const std::optional<RigidTransform>& consensus, const PoseBounds& bounds) {
  std::vector<RigidTransform> poses;
  for (const TrialRecord* record : records) {
    const RigidTransform* const pose = usable_pose(*record);
    if (pose == nullptr || (!lacks_truth(scene) && !record->error)) continue;
    const Measures deviations =
        measures_of(lacks_truth(scene) ? pose_error(*pose, *consensus) : *record->error);
    scene.usable_deviations.push_back(deviations);
    if (!counts(*record, scene, bounds)) continue;
    poses.push_back(*pose);
    scene.deviations.push_back(deviations);
  }
  if (poses.empty()) return;
  // With ground truth, counted trials need not agree with most others.
  const RigidTransform centre =
      lacks_truth(scene) ? *scene.consensus : consensus_pose(poses, bounds);
  for (const RigidTransform& pose : poses) {
    scene.spread.push_back(measures_of(pose_error(pose, centre)));
  }
}

/// Sets `SummaryRow::within_scene_std`; the scenes of `row` must be complete.
void set_within_scene_std(SummaryRow& row) {
  std::array<std::vector<double>, kDofs> squares;
  for (const SceneSummary& scene : row.scenes) {
    if (scene.counted < 2 || !is_judged_as(row, scene)) continue;
    row.within_scene_freedom += scene.counted - 1;
    for (std::size_t k = 0; k < kDofs; ++k) {
      const double std = standard_deviation(values_of(scene.spread, k));
      squares[k].push_back(std * std * (scene.counted - 1));
    }
  }
  if (row.within_scene_freedom == 0.0) return;
  DofValues& spread = row.within_scene_std.emplace();
  for (std::size_t k = 0; k < kDofs; ++k) {
    spread[k] = std::sqrt(compensated_sum(squares[k]) / row.within_scene_freedom);
  }
}

/// Sets `SummaryRow::across_scenes_std`; the scenes and the consensus of `row` must be complete.
void set_across_scenes_std(SummaryRow& row) {
  std::vector<Measures> centres;
  for (const SceneSummary& scene : row.scenes) {
    if (!scene.statistics || !is_judged_as(row, scene)) continue;
    Measures& centre = centres.emplace_back();
    if (row.deviations_from == DeviationsFrom::consensus) {
      centre = measures_of(pose_error(*scene.consensus, *row.consensus));
    } else {
      for (std::size_t k = 0; k < centre.size(); ++k) centre[k] = (*scene.statistics)[k][kMean];
    }
  }
  if (centres.size() < 2) return;
  row.across_scenes_freedom = static_cast<double>(centres.size() - 1);
  DofValues& spread = row.across_scenes_std.emplace();
  for (std::size_t k = 0; k < kDofs; ++k) spread[k] = standard_deviation(values_of(centres, k));
}

/// The deviations of all scenes, concatenated.
std::vector<Measures> joined(const std::vector<const SceneSummary*>& scenes,
                             std::vector<Measures> SceneSummary::*deviations) {
  std::vector<Measures> all;
  for (const SceneSummary* scene : scenes) {
    all.insert(all.end(), (scene->*deviations).begin(), (scene->*deviations).end());
  }
  return all;
}

/// Sets the consensus of all scenes of `row` from those of the scenes; `scenes` has their trials.
void set_consensus(SummaryRow& row, const std::vector<SceneRecords>& scenes,
                   const PoseBounds& bounds) {
  std::vector<RigidTransform> consensus;
  std::vector<std::optional<PoseCovariance>> covariances;
  std::vector<double> votes;
  SceneRecords all, of_agreeing_scenes;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneSummary& scene = row.scenes[i];
    all.insert(all.end(), scenes[i].begin(), scenes[i].end());
    if (!scene.consensus) continue;
    consensus.push_back(*scene.consensus);
    covariances.push_back(scene.covariance);
    votes.push_back(std::max(1, scene.agreeing.count));
    if (scene.agreeing.count == 0) continue;
    of_agreeing_scenes.insert(of_agreeing_scenes.end(), scenes[i].begin(), scenes[i].end());
  }
  if (consensus.empty()) return;
  row.consensus = consensus_pose(consensus, bounds, votes);
  const bool is_alone = all.size() == 1;
  // Trials that agree with no other trial of their scene may be near trials of another scene by
  // chance; they do not form a consensus.
  if (agreeing_with(*row.consensus, of_agreeing_scenes, bounds, is_alone).count > 0) {
    row.agreeing = agreeing_with(*row.consensus, all, bounds, is_alone);
  }
  const auto members = covariances_of_members(consensus, covariances, bounds, votes);
  if (members) row.covariance = covariance_of_mean(*members);
}

}  // namespace

void SceneCounts::add(const std::string& scene, int count, int trials) {
  Counts& counts = scenes_[scene];
  counts.count += count;
  counts.trials += trials;
}

Share SceneCounts::share() const {
  Share share;
  double squares = 0.0;
  int scenes = 0;
  for (const auto& [scene, counts] : scenes_) {
    share.count += counts.count;
    share.trials += counts.trials;
    squares += static_cast<double>(counts.trials) * counts.trials;
    scenes += counts.trials > 0;
  }
  if (share.trials == 0) return share;
  const double trials = share.trials;
  share.ratio = share.count / trials;
  if (scenes >= kMinScenes) {
    share.interval = wilson_interval(share.ratio, trials * trials / squares);
  }
  return share;
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
  return std::array{"truth", "consensus", "none"}.at(static_cast<std::size_t>(from));
}

const Share& main_share(const TrialSummary& summary) {
  return lacks_truth(summary) ? summary.agreement : summary.success;
}

PoseBounds pose_bounds(const SuccessBounds& bounds) {
  return {rad_from_deg(bounds.rotation_deg), bounds.translation_m};
}

TrialSummary pooled_counts(const std::vector<const SceneSummary*>& scenes) {
  TrialSummary sum;
  SceneCounts successes, agreements;
  std::set<std::string> names;
  for (const SceneSummary* scene : scenes) {
    sum.deviations_from = std::min(sum.deviations_from, scene->deviations_from);
  }
  for (const SceneSummary* scene : scenes) {
    names.insert(scene->scene);
    sum.outcomes.trials += scene->outcomes.trials;
    for (const auto count : kByStatus) sum.outcomes.*count += scene->outcomes.*count;
    // A single trial has no other to agree with.
    if (scene->outcomes.trials > 1) {
      agreements.add(scene->scene, scene->agreeing.count, scene->outcomes.trials);
    }
    if (!is_judged_as(sum, *scene)) continue;
    successes.add(scene->scene, scene->outcomes.success, scene->outcomes.trials);
    sum.counted += static_cast<int>(scene->deviations.size());
    sum.usable += static_cast<int>(scene->usable_deviations.size());
  }
  sum.scene_count = static_cast<int>(names.size());
  sum.success = successes.share();
  sum.agreement = agreements.share();
  return sum;
}

TrialSummary pooled(const std::vector<const SceneSummary*>& scenes) {
  TrialSummary sum = pooled_counts(scenes);
  if (scenes.size() == 1 && scenes.front()->usable_statistics) {
    // The statistics of one scene are already computed.
    sum.statistics = scenes.front()->statistics;
    sum.usable_statistics = scenes.front()->usable_statistics;
    return sum;
  }
  std::vector<const SceneSummary*> judged;
  std::copy_if(scenes.begin(), scenes.end(), std::back_inserter(judged),
               [&](const SceneSummary* scene) { return is_judged_as(sum, *scene); });
  if (sum.counted > 0) sum.statistics = statistics_of(joined(judged, &SceneSummary::deviations));
  if (sum.usable > sum.counted) {
    sum.usable_statistics = statistics_of(joined(judged, &SceneSummary::usable_deviations));
  } else {
    // All usable trials are counted.
    sum.usable_statistics = sum.statistics;
  }
  return sum;
}

std::vector<const SceneSummary*> scenes_of(const Rows& rows) {
  std::vector<const SceneSummary*> scenes;
  for (const SummaryRow* row : rows) {
    for (const SceneSummary& scene : row->scenes) scenes.push_back(&scene);
  }
  return scenes;
}

bool have_truth(const Rows& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const SummaryRow* row) {
    return row->deviations_from == DeviationsFrom::truth;
  });
}

Share successful_frames(const Rows& rows) {
  std::map<std::string, bool> succeeds;
  for (const SceneSummary* scene : scenes_of(rows)) {
    if (lacks_truth(*scene)) continue;
    const bool all = scene->outcomes.success == scene->outcomes.trials;
    bool& frame = succeeds.emplace(scene->scene, true).first->second;
    frame = frame && all;
  }
  SceneCounts counts;
  for (const auto& [scene, does] : succeeds) counts.add(scene, does ? 1 : 0, 1);
  return counts.share();
}

const TrialRecord* find_trial(const SceneRecords& records, int trial) {
  const auto is_before = [](const TrialRecord* record, int number) {
    return record->id.trial < number;
  };
  const auto found = std::lower_bound(records.begin(), records.end(), trial, is_before);
  return found != records.end() && (*found)->id.trial == trial ? *found : nullptr;
}

const RigidTransform* usable_pose(const TrialRecord& record) {
  const bool is_usable = record.status != Status::rejected && record.status != Status::failed;
  return is_usable && record.T_reference_sensor ? &*record.T_reference_sensor : nullptr;
}

std::optional<bool> agrees(const TrialRecord& record, const SceneSummary& scene,
                           const PoseBounds& bounds) {
  if (!scene.consensus || scene.outcomes.trials < 2) return std::nullopt;
  const std::optional<bool> near = is_near(record, *scene.consensus, bounds);
  return near ? std::optional<bool>(*near && scene.agreeing.count > 0) : std::nullopt;
}

SummaryRow summary_row(const std::vector<SceneRecords>& scenes, const PoseBounds& bounds,
                       bool without_truth) {
  SummaryRow row;
  row.variant = scenes.front().front()->id.variant;
  row.sensor = scenes.front().front()->id.sensor;
  for (const SceneRecords& records : scenes) {
    row.scenes.push_back(without_deviations(records, bounds));
  }
  set_consensus(row, scenes, bounds);
  // Ground truth if a trial of any scene has it.
  DeviationsFrom from = pooled_counts(scenes_of({&row})).deviations_from;
  if (without_truth) from = std::min(from, DeviationsFrom::consensus);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    SceneSummary& scene = row.scenes[i];
    if (from != DeviationsFrom::truth || !lacks_truth(scene)) scene.deviations_from = from;
    add_deviations(scene, scenes[i], row.consensus, bounds);
    static_cast<TrialSummary&>(scene) = pooled({&scene});
  }
  static_cast<TrialSummary&>(row) = pooled(scenes_of({&row}));
  set_within_scene_std(row);
  set_across_scenes_std(row);
  return row;
}

}  // namespace croon::experiments
