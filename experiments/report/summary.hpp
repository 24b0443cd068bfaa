#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/file/measures.hpp"
#include "experiments/report/claim_result.hpp"
#include "experiments/report/comparison.hpp"
#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/base/statistics.hpp"

namespace croon::experiments {

/// The order of rows and scenes in every report. A name that records have and the order lacks comes
/// last.
struct ReportOrder {
  std::vector<std::string> variants;
  std::vector<std::string> sensors;
  std::vector<std::string> scenes;
  std::map<std::string, std::string> kinds;  ///< By scene; nothing where the dataset tells none.
  std::vector<SensorPair> pairs = {};        ///< Of sensors that are pairs of others.
};

/// `names`, then in alphabetical order those that records have as `name` and `names` lacks.
std::vector<std::string> completed(std::vector<std::string> names,
                                   const std::vector<TrialRecord>& records,
                                   std::string TrialId::*name);

/// A share of a number of trials, with its 95 % interval (Wilson 1927).
struct Share {
  int count = 0;
  int trials = 0;
  double ratio = 0.0;  ///< 0 where there are no trials.
  Interval interval{0.0, 1.0};
};

/// How many trials ended how.
struct Outcomes {
  int trials = 0;
  int success = 0;
  int inaccurate = 0;
  int rejected = 0;
  int failed = 0;
};

/// What the deviations of one measure look like, in its unit.
struct MeasureStatistics {
  double mean = 0.0;
  double std = 0.0;  ///< Sample (n - 1); not a number where n is 1.
  double median = 0.0;
  double rmse = 0.0;
  double p95 = 0.0;  ///< 95th percentile of the absolute value.
};

/// A statistic for each of `kMeasures`.
using StatisticsTable = std::array<MeasureStatistics, kMeasures.size()>;

/// What the deviations are taken from.
enum class Reference {
  truth,      ///< Ground truth.
  consensus,  ///< There is no truth: what the trials of all scenes agree on.
  none        ///< Nothing finished.
};

/// One variant and sensor in one scene.
struct SceneSummary {
  std::string scene;
  std::string kind;  ///< "urban"; empty where the dataset tells none.
  Outcomes outcomes;
  Share success;
  Share agreement;  ///< Successful and within the success bounds of `consensus`.
  std::optional<RigidTransform>
      consensus;    ///< `T_reference_sensor` that its successful trials agree on.
  int counted = 0;  ///< Trials that `statistics` are over.
  std::optional<StatisticsTable> statistics;
  std::vector<Measures> deviations;  ///< Of the counted trials from the reference, by trial.
  std::vector<Measures> spread;      ///< Of the same trials from `consensus`.
};

/// One variant and sensor over all scenes.
///
/// Statistics are over the trials that count: against the truth those with status `success`;
/// without truth those within the success bounds of their scene's consensus. Deviations are from
/// the truth, else from `consensus`, by `pose_error`.
struct SummaryRow {
  std::string variant;
  std::string sensor;
  Reference reference = Reference::none;
  Outcomes outcomes;
  Share success;
  Share agreement;                          ///< Successful and near their scene's consensus.
  std::optional<RigidTransform> consensus;  ///< What the consensus poses of the scenes agree on.
  int counted = 0;
  std::optional<StatisticsTable> statistics;
  /// Of roll to z: the sample std of the trials that count about their scene's consensus, pooled
  /// over scenes by degrees of freedom; where a scene has two trials.
  std::optional<std::array<double, kDofs>> within_scene_std;
  /// Of roll to z: the sample std of the scenes' mean errors (no truth: of their consensus poses
  /// about the consensus of all); where there are two scenes.
  std::optional<std::array<double, kDofs>> across_scenes_std;
  std::vector<SceneSummary> scenes;
};

/// One variant and sensor in all scenes of one kind.
struct KindSummary {
  std::string variant;
  std::string kind;
  std::string sensor;                     ///< Empty for all sensors together.
  Reference reference = Reference::none;  ///< As in SummaryRow; truth where one sensor has it.
  int scenes = 0;
  Outcomes outcomes;
  Share success;
  Share agreement;  ///< As in SummaryRow.
  int counted = 0;  ///< Trials that `statistics` are over, as in SummaryRow.
  std::optional<StatisticsTable> statistics;
};

/// How far loops over the reference and two sensors, T_ref_target T_target_source T_source_ref, are
/// from the identity. That needs no truth: the three are found independently, from starts of their
/// own.
struct LoopClosure {
  std::string variant;
  SensorPair pair;
  Share closed;     ///< Of all loops, those within the success bounds of the identity.
  int counted = 0;  ///< Loops of three usable poses, what `statistics` are over.
  std::optional<StatisticsTable>
      statistics;  ///< Of T_ref_target T_target_source from T_ref_source.
};

/// Why trials ended as `rejected` or `failed`, and how many.
struct ReasonCount {
  std::string variant;
  Status status = Status::failed;
  std::string reason;
  int count = 0;
};

/// What an experiment came to.
struct Summary {
  SuccessBounds bounds;
  std::vector<SummaryRow> rows;         ///< By variant, then sensor.
  std::vector<KindSummary> kinds;       ///< By variant, then kind, then sensor, all together last.
  std::vector<Comparison> comparisons;  ///< With the first variant: by variant, then sensor, all.
  std::vector<LoopClosure> loops;       ///< By variant, then pair.
  std::vector<ReasonCount> reasons;     ///< The most frequent first.
};

/// Sums the records up. The order of the records makes no difference.
Summary summarise(const std::vector<TrialRecord>& records, const SuccessBounds& bounds,
                  const ReportOrder& order);

/// The variants of the summary, and its sensors, each once, in its order.
std::vector<std::string> variants_of(const Summary& summary);
std::vector<std::string> sensors_of(const Summary& summary);

/// "truth", "consensus" or "none".
const char* reference_name(Reference reference);

/// The bytes of summary.csv: one row per variant and sensor.
std::string summary_csv(const Summary& summary);

/// The bytes of summary_by_kind.csv: one row per variant, kind of scene and sensor, and one over
/// all sensors, whose name is "all".
std::string summary_by_kind_csv(const Summary& summary);

/// The bytes of comparison.csv: one row per variant and sensor, and one over all sensors, whose
/// name is "all". "inf" is the error of a trial without a usable result.
std::string comparison_csv(const Summary& summary);

/// The bytes of loops.csv: one row per variant and pair of sensors.
std::string loops_csv(const Summary& summary);

/// The scenes of a row that summary.json lists at most.
inline constexpr std::size_t kMaxJsonScenes = 100;

/// The bytes of summary.json: the rows of summary.csv with the scenes below each, the reasons, and
/// the comparisons, the kinds of scenes, the loops and the claims where there are some. Of more
/// than `kMaxJsonScenes` scenes, whose trials are in trials.csv, none is listed: "scenes" is null.
std::string summary_json(const Summary& summary, const std::vector<ClaimResult>& claims = {});

}  // namespace croon::experiments
