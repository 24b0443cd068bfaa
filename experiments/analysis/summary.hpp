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

/// The order of rows and scenes in every report, and what trials do not say of them. A name that
/// records have and the order lacks comes last.
struct ReportOrder {
  std::vector<std::string> variants;
  std::vector<std::string> sensors;
  std::vector<std::string> scenes;
  std::map<std::string, std::string> scene_kinds;  ///< By scene; not all scenes have one.
  std::vector<SensorPair> pairs = {};              ///< Of sensors that are pairs of others.
  std::set<std::string> without_truth = {};        ///< Sensors whose success is not known.
};

/// `names`, then in alphabetical order those that records have as `name` and `names` lacks.
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
  Share frames;  ///< Of all scenes.
};

/// The result of a paired test; its p values are two-sided.
struct PairedTest {
  bool favours_variant = false;  ///< Whether the sum of the test's scores is on its side.
  double p = 1.0;                ///< If every trial is independent.
  double p_holm = 1.0;           ///< The same, corrected for all tests of the sensor (Holm 1979).
  double p_by_scene = 1.0;       ///< If scenes are the independent units.
  double p_by_scene_holm = 1.0;
};

/// Whether the difference is significant over trials: corrected p below 0.05.
bool is_significant(const PairedTest& test);

/// Whether the difference is significant over trials and with scenes as units.
bool holds_by_scene(const PairedTest& test);

/// An error of both sides over the same trials; infinite for trials without a usable result.
struct ErrorComparison {
  double base_median = 0.0;
  double variant_median = 0.0;
  double difference = 0.0;           ///< Of the medians, variant - base; 0 if both are infinite.
  std::optional<Interval> interval;  ///< 95 % bootstrap interval of `difference`, over scenes; none
                                     ///< for fewer than `kLeastScenes`.
  double paired_difference = 0.0;    ///< The median of the differences of the pairs.
  std::optional<Interval> paired_interval;  ///< That of `paired_difference`, as `interval`.
  PairedTest test;                          ///< Wilcoxon's signed-rank test.
};

/// The trials that both a variant and the base have.
struct ComparedTrials {
  std::string variant;
  std::string base;
  std::string sensor;  ///< Empty for all sensors together.
  int pairs = 0;
  int scenes = 0;
};

/// A variant against the base. Errors are from the truth; if there is none, from the pose that the
/// side's own trials of the scene agree on.
struct Comparison : ComparedTrials {
  int only_base = 0;     ///< Pairs that the base alone won (no truth: in which it alone agreed).
  int only_variant = 0;  ///< Pairs that the variant alone won.
  ErrorComparison rotation_deg;
  ErrorComparison translation_m;
  PairedTest success;  ///< McNemar's test.
};

/// The size of the error in one degree of freedom of a variant against the base.
struct DofComparison : ComparedTrials {
  std::size_t dof = 0;  ///< Index in kMeasures.
  ErrorComparison error;
};

/// How far one loop is from the identity.
struct LoopGap {
  bool is_closed = false;    ///< Within the success bounds.
  Measures deviations = {};  ///< Of T_ref_target T_target_source from T_ref_source.
};

/// How far loops over the reference and two sensors, T_ref_target T_target_source T_source_ref, are
/// from the identity. That needs no truth: the three poses are found independently, each from its
/// own start.
struct LoopClosure {
  std::string variant;
  SensorPair pair;
  Share closed;     ///< Of all loops, those within the success bounds of the identity.
  int counted = 0;  ///< Loops of three usable poses, the loops that `statistics` are over.
  std::optional<StatisticsTable>
      statistics;                 ///< Of T_ref_target T_target_source from T_ref_source.
  std::optional<LoopGap> agreed;  ///< Of the loop over the poses that all scenes agree on.
  int scenes = 0;                 ///< With trials of all three calibrations.
  int scenes_closed = 0;          ///< Whose loop over their consensus poses is closed.
};

/// A reason of trials (TrialRecord::reason), and their number.
struct ReasonCount {
  std::string variant;
  Status status = Status::failed;
  std::string reason;
  int count = 0;
};

/// What a success curve bounds.
enum class CurveOf { rotation, translation, both };

/// "rotation", "translation" or "both".
const char* name_of(CurveOf of);

/// The share of all trials that end within each of some thresholds of the truth.
struct CurveRow {
  std::string variant;
  std::string sensor;  ///< Empty for all together.
  CurveOf of = CurveOf::both;
  std::vector<Share> shares;  ///< By threshold.
};

/// Success as a curve over the threshold. Thresholds are the success bounds times a factor; at 1
/// the curve of both is the success.
struct SuccessCurve {
  std::vector<SuccessBounds> thresholds;  ///< Ascending.
  std::vector<CurveRow> rows;  ///< By variant, then sensor (all together last), then `CurveOf`;
                               ///< none without truth or with a bound of zero.
};

/// Variant and sensor; the sensor is empty for all together.
using VariantSensor = std::pair<std::string, std::string>;

/// The results of an experiment.
struct Summary {
  SuccessBounds bounds;
  std::vector<SummaryRow> rows;               ///< By variant, then sensor.
  std::vector<SceneKindSummary> scene_kinds;  ///< By variant, kind and sensor, all together last;
                                              ///< empty if no scene has a kind.
  std::vector<FrameSummary> frames;     ///< By variant; none for one sensor, or without truth.
  std::vector<Comparison> comparisons;  ///< With the first variant: by variant, then sensor, all.
  std::vector<DofComparison> dof_comparisons;  ///< The same, by degree of freedom.
  std::set<VariantSensor> below_best;          ///< See `below_best`.
  std::vector<LoopClosure> loops;              ///< By variant, then pair.
  SuccessCurve curve;
  std::vector<ReasonCount> reasons;  ///< The most frequent first.
};

/// Sums the records up. The order of the records makes no difference.
Summary summarise(const std::vector<TrialRecord>& records, const SuccessBounds& bounds,
                  const ReportOrder& order);

/// The variants of the summary, and its sensors, each once, in its order.
std::vector<std::string> variants_of(const Summary& summary);
std::vector<std::string> sensors_of(const Summary& summary);

/// The rows of a variant, of all its sensors if `sensor` is empty.
Rows rows_of(const Summary& summary, const std::string& variant, const std::string& sensor = "");

/// The records of each (variant, sensor, scene); a group that is not there is empty.
class RecordGroups {
 public:
  explicit RecordGroups(const std::vector<TrialRecord>& records);
  const SceneRecords& of(const std::string& variant, const std::string& sensor,
                         const std::string& scene) const;

 private:
  std::map<std::tuple<std::string, std::string, std::string>, SceneRecords> groups_;
};

/// Adds the comparisons of every variant with `base` over the trials that both have: by variant,
/// then sensor as in the rows of `summary`, then all sensors together. `groups` are the records of
/// the rows. Without common trials there is no comparison. p values are corrected over the three
/// tests of all variants with the same sensor; those by degree of freedom among themselves.
void compare_with_base(const std::string& base, Summary& summary, const RecordGroups& groups,
                       const PoseBounds& bounds);

/// The variants whose success with a sensor is below that of the best: significantly by McNemar's
/// test over the trials that both have (p < 0.05), or by more than 5 percentage points. Their
/// errors are those of easier trials, so tables do not show them as the best. `groups` are the
/// records of the rows.
std::set<VariantSensor> below_best(const Summary& summary, const RecordGroups& groups,
                                   const PoseBounds& bounds);

/// The curves of the rows of `summary` that have truth. Trials without a usable pose are beyond
/// every threshold. `groups` are the records of the rows.
SuccessCurve success_curve(const Summary& summary, const RecordGroups& groups);

/// The loops of one variant and pair over `scenes`: trial i of the pair, of its source and of its
/// target are a loop if all three are in `groups`. `rows` are those of the variant.
LoopClosure close_loops(const RecordGroups& groups, const Rows& rows, const std::string& variant,
                        const SensorPair& pair, const std::vector<std::string>& scenes,
                        const PoseBounds& bounds);

}  // namespace croon::experiments
