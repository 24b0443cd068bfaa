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

/// With fewer scenes, shares and differences have no interval: six is the minimum for which a test
/// over scenes can be significant (docs/statistics.md).
inline constexpr int kMinScenes = 6;

/// A share of a number of trials, with its 95 % interval.
struct Share {
  int count = 0;
  int trials = 0;
  double ratio = 0.0;                     ///< 0 if there are no trials.
  std::optional<Interval> interval = {};  ///< Over scenes, see SceneCounts::share.
};

/// The numbers of all trials and of counted trials, by scene.
class SceneCounts {
 public:
  void add(const std::string& scene, int count, int trials);
  /// The share of counted trials. Trials of one scene are dependent, so the interval is Wilson's
  /// (1927) for a number of trials equal to the number of scenes: the maximum design effect (Kish
  /// 1965). Scenes with different numbers n_i of trials count as (sum n_i)^2 / sum n_i^2 scenes. No
  /// interval for fewer than `kMinScenes` scenes.
  Share share() const;

 private:
  struct Counts {
    int count = 0;
    int trials = 0;
  };
  std::map<std::string, Counts> scenes_;
};

/// The numbers of trials by outcome.
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

/// One of the statistics of measure `measure`; std::nullopt if too few trials are counted.
std::optional<double> value_of(const std::optional<StatisticsTable>& table, std::size_t measure,
                               std::size_t statistic);

/// One value per DOF, in the units of `kMeasures`.
using DofValues = std::array<double, kDofs>;

/// The pose that deviations are computed from.
enum class DeviationsFrom {
  truth,      ///< Ground truth.
  consensus,  ///< Without ground truth: the consensus of the trials of all scenes.
  none        ///< No trial finished; ground truth may exist.
};

/// "truth", "consensus" or "none".
const char* name_of(DeviationsFrom from);

/// The trials whose usable poses are within the success bounds of a pose.
struct Agreeing {
  int count = 0;               ///< At least two of several trials, else 0.
  double rotation_deg = 0.0;   ///< Root mean square of their angles from the pose.
  double translation_m = 0.0;  ///< Root mean square of their distances from the pose.
};

/// The results of a set of trials.
struct TrialSummary {
  DeviationsFrom deviations_from = DeviationsFrom::none;  ///< Truth if any sensor has it.
  int scene_count = 0;                                    ///< Number of scenes of the trials.
  Outcomes outcomes;
  /// Share of trials with status `success` among the judged ones (is_judged_as); meaningless
  /// without ground truth.
  Share success;
  Share agreement;  ///< Trials for which `agrees` is true, of scenes with several trials.
  int counted = 0;  ///< Number of trials in `statistics`.
  std::optional<StatisticsTable> statistics;
  int usable = 0;  ///< Number of trials with a `usable_pose`, successful or not.
  std::optional<StatisticsTable> usable_statistics;
};

/// One variant and sensor in one scene.
struct SceneSummary : TrialSummary {
  std::string scene;
  std::string scene_kind;  ///< "urban"; empty if the dataset has no kinds.
  std::optional<RigidTransform>
      consensus;  ///< `T_reference_sensor` on which its usable poses agree.
  /// The covariance of `consensus`: the mean over the trials near it, which share their data;
  /// std::nullopt if one of them has none.
  std::optional<PoseCovariance> covariance;
  Agreeing agreeing;                        ///< The trials for which `agrees` is true.
  std::vector<Measures> deviations;         ///< Of the counted trials, by trial.
  std::vector<Measures> usable_deviations;  ///< Of the trials with a usable pose.
  /// The deviations of the same trials from their consensus.
  std::vector<Measures> spread;
};

/// One variant and sensor over all scenes.
///
/// Statistics are over the counted trials. With ground truth these are the trials with status
/// `success`; without it, the trials that agree, and the trial of a scene with a single trial.
/// Deviations are from ground truth or else from `consensus`, by `pose_error`.
struct SummaryRow : TrialSummary {
  std::string variant;
  std::string sensor;  ///< Empty for all sensors together.
  /// The pose that the consensus poses of the scenes agree on, each weighted by the number of its
  /// trials that agree with it.
  std::optional<RigidTransform> consensus;
  /// The covariance of `consensus`, a mean over the scenes near it, whose errors are assumed
  /// independent; std::nullopt if one of them has none.
  std::optional<PoseCovariance> covariance;
  /// The trials of all scenes that are near `consensus`. Empty unless at least two of them (or the
  /// only trial) belong to scenes whose trials agree or that have a single trial.
  Agreeing agreeing;
  /// The sample std of the counted trials about their scene's consensus, pooled over scenes by
  /// degrees of freedom; std::nullopt if no scene has two such trials.
  std::optional<DofValues> within_scene_std;
  double within_scene_freedom = 0.0;
  /// The sample std of the scenes' mean errors (without ground truth: of their consensus poses
  /// about the consensus of all); std::nullopt for fewer than two scenes.
  std::optional<DofValues> across_scenes_std;
  double across_scenes_freedom = 0.0;
  std::vector<SceneSummary> scenes;
};

/// The consensus of a scene or of all scenes, if trials agree on it: at least two, or the only one.
/// Null if no two trials agree, because the consensus is then not a result.
template <class Summary>
const RigidTransform* agreed_consensus(const Summary& summary) {
  return summary.consensus && summary.agreeing.count > 0 ? &*summary.consensus : nullptr;
}

/// Rows of a summary.
using Rows = std::vector<const SummaryRow*>;

/// The share that measures success: with ground truth success, else agreement.
const Share& main_share(const TrialSummary& summary);

/// Whether success is unknown, because deviations are from a consensus.
inline bool lacks_truth(const TrialSummary& summary) {
  return summary.deviations_from == DeviationsFrom::consensus;
}

/// Whether the trials of `part` are included in the success and the statistics of `all`, to which
/// it belongs: if other parts have ground truth, parts without it are excluded.
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

/// The trials of several scenes (of one or more sensors) as one set, without statistics.
TrialSummary pooled_counts(const std::vector<const SceneSummary*>& scenes);

/// The same with statistics.
TrialSummary pooled(const std::vector<const SceneSummary*>& scenes);

/// The scenes of all `rows`.
std::vector<const SceneSummary*> scenes_of(const Rows& rows);

/// The share of successful frames: scenes in which every trial of each sensor of `rows`, which are
/// of one variant, succeeds. Meaningless without ground truth.
Share successful_frames(const Rows& rows);

/// The trials of one variant, sensor and scene, by trial.
using SceneRecords = std::vector<const TrialRecord*>;

/// The record of trial `trial`; null if there is none.
const TrialRecord* find_trial(const SceneRecords& records, int trial);

/// The pose of a trial that finished and was not rejected; else null.
const RigidTransform* usable_pose(const TrialRecord& record);

/// Whether the usable pose of a trial is within `bounds` of the consensus of its scene together
/// with that of at least one other trial; std::nullopt without a usable pose, or if the scene has
/// no other trial. The only definition of agreement.
std::optional<bool> agrees(const TrialRecord& record, const SceneSummary& scene,
                           const PoseBounds& bounds);

/// The row of the trials in `scenes`, which are of one variant and sensor; not empty.
/// `without_truth` states that there is no ground truth, even if no trial finished.
SummaryRow summary_row(const std::vector<SceneRecords>& scenes, const PoseBounds& bounds,
                       bool without_truth);

}  // namespace croon::experiments
