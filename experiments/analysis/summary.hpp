#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "experiments/analysis/trial_summary.hpp"
#include "experiments/run/sensor_pairs.hpp"

namespace croon::experiments {

/// The order of rows and scenes in all reports, and properties that trials do not record. Names
/// that occur in records but not here come last.
struct ReportOrder {
  std::vector<std::string> variants;
  std::vector<std::string> sensors;
  std::vector<std::string> scenes;
  std::map<std::string, std::string> scene_kinds;  ///< By scene; some scenes may have none.
  std::vector<SensorPair> pairs = {};              ///< Pairs of sensors that count as sensors.
  std::set<std::string> without_truth = {};        ///< Sensors without ground truth.
};

/// `names`, followed in alphabetical order by the other names that records have as `name`.
std::vector<std::string> completed(std::vector<std::string> names,
                                   const std::vector<TrialRecord>& records,
                                   std::string TrialId::*name);

/// One variant and sensor in all scenes of one kind.
struct SceneKindSummary : TrialSummary {
  std::string variant;
  std::string scene_kind;
  std::string sensor;  ///< Empty for all sensors together.
};

/// The scenes in which every trial of all sensors of a variant succeeds.
struct FrameSummary {
  std::string variant;
  Share frames;  ///< Share of all scenes.
};

/// The result of a paired test; its p values are two-sided.
struct PairedTest {
  bool favours_variant = false;  ///< Whether the sum of the scores favours the variant.
  double p = 1.0;                ///< Assuming independent trials.
  double p_holm = 1.0;           ///< Corrected for all tests of the sensor (Holm 1979).
  double p_by_scene = 1.0;       ///< Assuming independent scenes.
  double p_by_scene_holm = 1.0;
};

/// Whether the difference is significant over trials: corrected p below 0.05.
bool is_significant(const PairedTest& test);

/// Whether the difference is significant both over trials and with scenes as units.
bool is_significant_by_scene(const PairedTest& test);

/// One of the errors, compared between both sides over the same trials; infinite for trials without
/// a usable result.
struct ErrorComparison {
  double base_median = 0.0;
  double variant_median = 0.0;
  double difference = 0.0;           ///< Of medians, variant - base; 0 if both are infinite.
  std::optional<Interval> interval;  ///< 95 % bootstrap interval of `difference`, over scenes;
                                     ///< requires `kMinScenes`.
  double paired_difference = 0.0;    ///< The median of the paired differences.
  std::optional<Interval> paired_interval;  ///< Of `paired_difference`, like `interval`.
  PairedTest test;                          ///< Wilcoxon's signed-rank test.
};

/// The trials that a variant and the base have in common.
struct ComparedTrials {
  std::string variant;
  std::string base;
  std::string sensor;  ///< Empty for all sensors together.
  int pairs = 0;
  int scenes = 0;
};

/// A variant compared with the base. Errors are relative to ground truth or, without it, to the
/// consensus of the side's own trials of the scene.
struct Comparison : ComparedTrials {
  int only_base = 0;     ///< Pairs that only the base won (no ground truth: only it agreed).
  int only_variant = 0;  ///< Pairs that only the variant won.
  ErrorComparison rotation_deg;
  ErrorComparison translation_m;
  PairedTest success;  ///< McNemar's test.
};

/// The absolute error in one degree of freedom of a variant compared with the base.
struct DofComparison : ComparedTrials {
  std::size_t dof = 0;  ///< Index in kMeasures.
  ErrorComparison error;
};

/// The deviation of one loop from the identity.
struct LoopGap {
  bool is_closed = false;    ///< Within the success bounds.
  Measures deviations = {};  ///< Of T_ref_target T_target_source from T_ref_source.
};

/// The deviations of loops over the reference and two sensors, T_ref_target T_target_source
/// T_source_ref, from the identity. They need no ground truth: the three poses are estimated
/// independently, each from its own initial guess.
struct LoopClosure {
  std::string variant;
  SensorPair pair;
  Share closed;     ///< Share of all loops within the success bounds of the identity.
  int counted = 0;  ///< Loops of three usable poses, included in `statistics`.
  std::optional<StatisticsTable>
      statistics;                 ///< Of T_ref_target T_target_source from T_ref_source.
  std::optional<LoopGap> agreed;  ///< Loop over the consensus poses of all scenes.
  int scenes = 0;                 ///< Scenes with trials of all three calibrations.
  int scenes_closed = 0;          ///< Scenes whose loop over consensus poses is closed.
};

/// A reason of trials (TrialRecord::reason), and the number of these trials.
struct ReasonCount {
  std::string variant;
  Status status = Status::failed;
  std::string reason;
  int count = 0;
};

/// The errors that a success curve bounds.
enum class CurveOf { rotation, translation, both };

/// "rotation", "translation" or "both".
const char* name_of(CurveOf of);

/// The share of all trials within each threshold of ground truth.
struct CurveRow {
  std::string variant;
  std::string sensor;  ///< Empty for all sensors together.
  CurveOf of = CurveOf::both;
  std::vector<Share> shares;  ///< By threshold.
};

/// Success as a function of the threshold. Thresholds are multiples of the success bounds; at
/// factor 1 the curve of both errors is the success.
struct SuccessCurve {
  std::vector<SuccessBounds> thresholds;  ///< Ascending.
  std::vector<CurveRow> rows;  ///< By variant, sensor (all sensors together last), `CurveOf`;
                               ///< none without ground truth or with a bound of zero.
};

/// Variant and sensor; an empty sensor is all sensors together.
using VariantSensor = std::pair<std::string, std::string>;

/// The results of an experiment.
struct Summary {
  SuccessBounds bounds;
  std::vector<SummaryRow> rows;               ///< By variant, then sensor.
  std::vector<SceneKindSummary> scene_kinds;  ///< By variant, kind and sensor (all sensors last);
                                              ///< empty if no scene has a kind.
  std::vector<FrameSummary> frames;  ///< By variant; none for one sensor or without ground truth.
  std::vector<Comparison> comparisons;  ///< With the first variant: by variant, then sensor, all.
  std::vector<DofComparison> dof_comparisons;  ///< The same, by degree of freedom.
  std::set<VariantSensor> below_best;          ///< See `below_best`.
  std::vector<LoopClosure> loops;              ///< By variant, then pair.
  SuccessCurve curve;
  std::vector<ReasonCount> reasons;  ///< The most frequent first.
};

/// Summarises the records. Independent of the order of the records.
Summary summarise(const std::vector<TrialRecord>& records, const SuccessBounds& bounds,
                  const ReportOrder& order);

/// The distinct variants of the summary, and its sensors, in its order.
std::vector<std::string> variants_of(const Summary& summary);
std::vector<std::string> sensors_of(const Summary& summary);

/// The rows of a variant and sensor; of all sensors if `sensor` is empty.
Rows rows_of(const Summary& summary, const std::string& variant, const std::string& sensor = "");

/// The records of each (variant, sensor, scene); missing groups are empty.
class RecordGroups {
 public:
  explicit RecordGroups(const std::vector<TrialRecord>& records);
  const SceneRecords& of(const std::string& variant, const std::string& sensor,
                         const std::string& scene) const;

 private:
  std::map<std::tuple<std::string, std::string, std::string>, SceneRecords> groups_;
};

/// Adds the comparisons of every variant with `base` over common trials: by variant, then sensor as
/// in the rows of `summary`, then all sensors together. `groups` are the records of the rows.
/// Variants without common trials are not compared. p values are corrected over the three tests of
/// all variants for the same sensor. The p values per degree of freedom are corrected separately.
void compare_with_base(const std::string& base, Summary& summary, const RecordGroups& groups,
                       const PoseBounds& bounds);

/// The variants whose success with a sensor is below that of the best: significantly by McNemar's
/// test over common trials (p < 0.05), or by more than 5 percentage points. Their errors are over
/// easier trials, so tables do not mark them as the best. `groups` are the records of the rows.
std::set<VariantSensor> below_best(const Summary& summary, const RecordGroups& groups,
                                   const PoseBounds& bounds);

/// The curves of the rows of `summary` that have ground truth. Trials without a usable pose exceed
/// every threshold. `groups` are the records of the rows.
SuccessCurve success_curve(const Summary& summary, const RecordGroups& groups);

/// The loops of one variant and pair over `scenes`: trial i of the pair, of its source and of its
/// target form a loop if all three are in `groups`. `rows` are those of the variant.
LoopClosure close_loops(const RecordGroups& groups, const Rows& rows, const std::string& variant,
                        const SensorPair& pair, const std::vector<std::string>& scenes,
                        const PoseBounds& bounds);

}  // namespace croon::experiments
