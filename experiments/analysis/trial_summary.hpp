#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/file/measures.hpp"
#include "experiments/file/statistics.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/geometry/pose_mean.hpp"

namespace croon::experiments {

/// With fewer scenes a share and a difference have no interval: six are the fewest with which a
/// test over scenes can be significant (docs/statistics.md).
inline constexpr int kLeastScenes = 6;

/// A share of a number of trials, with its 95 % interval.
struct Share {
  int count = 0;
  int trials = 0;
  double ratio = 0.0;                     ///< 0 if there are no trials.
  std::optional<Interval> interval = {};  ///< Over scenes, see wilson_interval.
};

/// Trials by scene: all, and those that are counted.
class SceneCounts {
 public:
  void add(const std::string& scene, int count, int trials);
  /// Their share. Trials of one scene are alike, so the interval is Wilson's (1927) for as many
  /// trials as there are scenes: the design effect (Kish 1965) at its largest. Scenes of
  /// unequal numbers n_i of trials are (sum n_i)^2 / sum n_i^2 scenes. None for fewer than
  /// `kLeastScenes` scenes.
  Share share() const;

 private:
  struct Counts {
    int count = 0;
    int trials = 0;
  };
  std::map<std::string, Counts> scenes_;
};

/// The number of trials by how they ended.
struct Outcomes {
  int trials = 0;
  int success = 0;
  int inaccurate = 0;
  int finished = 0;
  int rejected = 0;
  int failed = 0;
};

/// The values of one measure.
std::vector<double> values_of(const std::vector<Measures>& rows, std::size_t measure);

/// The statistics of each of `kMeasures`, in its unit.
using StatisticsTable = std::array<Statistics, kMeasures.size()>;

/// The statistics of each measure; `deviations` must not be empty.
StatisticsTable statistics_of(const std::vector<Measures>& deviations);

/// One of the statistics of measure `measure`; std::nullopt if too few trials count.
std::optional<double> value_of(const std::optional<StatisticsTable>& table, std::size_t measure,
                               std::size_t statistic);

/// One value per DOF, in the units of `kMeasures`.
using DofValues = std::array<double, kDofs>;

/// The pose that deviations are taken from.
enum class DeviationsFrom {
  truth,      ///< Ground truth.
  consensus,  ///< There is no truth: the pose that the trials of all scenes agree on.
  none        ///< No trial finished, and there may be truth.
};

/// "truth", "consensus" or "none".
const char* name_of(DeviationsFrom from);

/// The trials whose usable poses are within the success bounds of a pose.
struct Agreeing {
  int count = 0;               ///< Of several trials at least two, else 0.
  double rotation_deg = 0.0;   ///< The root mean square of their angles from it.
  double translation_m = 0.0;  ///< The root mean square of their distances from it.
};

/// The results of a set of trials.
struct TrialSummary {
  DeviationsFrom deviations_from = DeviationsFrom::none;  ///< Truth if one sensor has it.
  int scene_count = 0;                                    ///< Scenes that the trials are of.
  Outcomes outcomes;
  /// Trials with status `success`, of those that are judged (is_judged_as); means nothing without
  /// truth.
  Share success;
  Share agreement;  ///< Trials that `agrees` is true for, of those of scenes with several trials.
  int counted = 0;  ///< Trials that `statistics` are over.
  std::optional<StatisticsTable> statistics;
  int usable = 0;  ///< Trials with a `usable_pose`, successful or not.
  std::optional<StatisticsTable> usable_statistics;
};

/// One variant and sensor in one scene.
struct SceneSummary : TrialSummary {
  std::string scene;
  std::string scene_kind;  ///< "urban"; empty if the dataset names none.
  std::optional<RigidTransform>
      consensus;  ///< `T_reference_sensor` that its usable poses agree on.
  /// Of `consensus`: the mean over the trials near it, which share their data; std::nullopt if one
  /// of them has none.
  std::optional<PoseCovariance> covariance;
  Agreeing agreeing;                        ///< The trials that `agrees` is true for.
  std::vector<Measures> deviations;         ///< Of the trials that count, by trial.
  std::vector<Measures> usable_deviations;  ///< Of the trials with a usable pose.
  /// The deviations of the same trials from what they agree on.
  std::vector<Measures> spread;
};

/// One variant and sensor over all scenes.
///
/// Statistics are over the trials that count: with truth those with status `success`; without truth
/// those that agree, and the trial of a scene that has one alone. Deviations are from the truth,
/// else from `consensus`, by `pose_error`.
struct SummaryRow : TrialSummary {
  std::string variant;
  std::string sensor;  ///< Empty for all sensors together.
  /// The pose that the consensus poses of the scenes agree on, each with as many votes as trials of
  /// its scene agree with it.
  std::optional<RigidTransform> consensus;
  /// Of `consensus`, a mean over the scenes near it, whose errors are taken as independent;
  /// std::nullopt if one of them has none.
  std::optional<PoseCovariance> covariance;
  /// The trials of all scenes that are near `consensus`; none unless two of them, or the only trial
  /// of all, are of scenes whose trials agree or that have one trial.
  Agreeing agreeing;
  /// The sample std of the trials that count about their scene's consensus, pooled over scenes by
  /// degrees of freedom; std::nullopt if no scene has two such trials.
  std::optional<DofValues> within_scene_std;
  double within_scene_freedom = 0.0;
  /// The sample std of the scenes' mean errors (no truth: of their consensus poses about the
  /// consensus of all); std::nullopt for fewer than two scenes.
  std::optional<DofValues> across_scenes_std;
  double across_scenes_freedom = 0.0;
  std::vector<SceneSummary> scenes;
};

/// The consensus of a scene or of all scenes, if trials agree on it: at least two, or one that has
/// no other. Null if no two trials agree: then it is no result.
template <class Summary>
const RigidTransform* agreed_consensus(const Summary& summary) {
  return summary.consensus && summary.agreeing.count > 0 ? &*summary.consensus : nullptr;
}

/// Rows of a summary.
using Rows = std::vector<const SummaryRow*>;

/// The share of the trials that count: with truth success, else agreement.
const Share& main_share(const TrialSummary& summary);

/// Whether success is not known, because deviations are from a consensus.
inline bool lacks_truth(const TrialSummary& summary) {
  return summary.deviations_from == DeviationsFrom::consensus;
}

/// Whether the trials of `part` count in the success and the statistics of `all`, of which it is a
/// part: where others have truth, those without do not.
inline bool is_judged_as(const TrialSummary& all, const TrialSummary& part) {
  return all.deviations_from != DeviationsFrom::truth || !lacks_truth(part);
}

/// Whether the deviations of all rows are errors.
bool have_truth(const Rows& rows);

/// The agreement of trials; null if no scene has several trials.
inline const Share* agreement_of(const TrialSummary& summary) {
  return summary.agreement.trials > 0 ? &summary.agreement : nullptr;
}

/// The success bounds in radians and metres.
PoseBounds pose_bounds(const SuccessBounds& bounds);

/// The trials of several scenes (of one sensor or more) as one set, without statistics.
TrialSummary pooled_counts(const std::vector<const SceneSummary*>& scenes);

/// The same with statistics.
TrialSummary pooled(const std::vector<const SceneSummary*>& scenes);

/// The scenes of all `rows`.
std::vector<const SceneSummary*> scenes_of(const Rows& rows);

/// The frames that succeed: scenes in which every trial of each sensor of `rows` does, of one
/// variant. They mean nothing without truth.
Share successful_frames(const Rows& rows);

/// The trials of one variant, sensor and scene, by trial.
using SceneRecords = std::vector<const TrialRecord*>;

/// The record of trial `trial`; null if there is none.
const TrialRecord* find_trial(const SceneRecords& records, int trial);

/// The pose of a trial that finished and is not rejected; else null.
const RigidTransform* usable_pose(const TrialRecord& record);

/// Whether the usable pose of a trial is within `bounds` of the consensus of its scene, and that of
/// another trial too; std::nullopt if it has none, or if the scene has no other trial. The only
/// place that decides it.
std::optional<bool> agrees(const TrialRecord& record, const SceneSummary& scene,
                           const PoseBounds& bounds);

/// The row of the trials in `scenes`, which are of one variant and sensor; not empty. Of
/// `without_truth` it is known that there is no truth, also if no trial finished.
SummaryRow summary_row(const std::vector<SceneRecords>& scenes, const PoseBounds& bounds,
                       bool without_truth);

}  // namespace croon::experiments
