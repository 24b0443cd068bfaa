#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/basin.hpp"
#include "experiments/analysis/claims.hpp"
#include "experiments/analysis/coverage.hpp"
#include "experiments/analysis/diagnostics.hpp"
#include "experiments/analysis/summary.hpp"
#include "experiments/analysis/verdicts.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/pipeline/cloud_description.hpp"
#include "framework/table/table.hpp"

namespace croon::experiments {

/// Adds the column "sensor" for objects with that member; empty for all sensors together.
template <class Row>
void add_sensor(Columns<Row>& columns) {
  columns.add({"sensor", "", "", 0, Better::neither, false, true},
              [](const Row& row) { return nothing_if_empty(row.sensor); });
}

/// The column of a measure and a statistic, "pitch_mean_deg"; `path` as in `Column`.
Column statistic_column(const Measure& measure, const std::string& statistic,
                        const std::string& path = "");

/// Columns of one value per DOF, called `name`: "roll_within_scene_std_deg".
Columns<DofValues> dof_columns(const std::string& name);

/// Variant, scene, sensor and number of a trial.
Columns<TrialId> id_columns();

/// The ends of an optional interval.
inline std::optional<double> low_of(const std::optional<Interval>& interval) {
  return interval ? std::optional<double>(interval->low) : std::nullopt;
}
inline std::optional<double> high_of(const std::optional<Interval>& interval) {
  return interval ? std::optional<double>(interval->high) : std::nullopt;
}

/// Translation and quaternion (qw >= 0); in JSON below `path`, the quaternion at `path` +
/// `rotation`.
Columns<RigidTransform> pose_columns(const std::string& path = "",
                                     const std::string& rotation = "/rotation_xyzw");

/// A consensus pose, as in extrinsics.json.
struct AgreedPose {
  std::optional<RigidTransform> pose;  ///< `T_reference_sensor`; std::nullopt if no two agree.
  int trials = 0;                      ///< All trials, including those without a pose.
  Agreeing agreeing;
  std::optional<PoseCovariance> covariance;  ///< Only if all agreeing poses have one.
};

/// The consensus of all scenes, and that of the trials of one scene.
AgreedPose agreed_pose(const SummaryRow& row);
AgreedPose agreed_pose(const SceneSummary& scene);

/// Matrix, translation, quaternion (x, y, z, w with w >= 0), roll, pitch and yaw (R = Rz(yaw)
/// Ry(pitch) Rx(roll)), the number of agreeing trials, and their root mean square distances.
Columns<AgreedPose> agreed_pose_columns();

/// The columns of summary_by_kind.csv and of "kinds" in summary.json: a row per variant, kind of
/// scene and sensor, and one over all sensors, with the sensor "all".
Columns<SceneKindSummary> scene_kind_columns();
/// The columns of comparison.csv and of "comparisons" in summary.json, with such rows too, and
/// those of comparison_by_dof.csv. The error of a trial without a usable result is "inf".
Columns<Comparison> comparison_columns();
Columns<DofComparison> dof_comparison_columns();
/// The columns of loops.csv; of clouds.csv; of "claims" and of "reasons" in summary.json.
Columns<LoopClosure> loop_columns();
Columns<CloudDescription> cloud_columns();
Columns<ClaimResult> claim_columns();
Columns<ReasonCount> reason_columns();
/// The columns of "frames" in summary.json.
Columns<FrameSummary> frame_columns();

/// Whether any row of a table has this value in the column "reference".
bool has_deviations_from(const Table& table, DeviationsFrom from);

/// The shares shown for a table with a column "reference": "success", and "agreement" if any row
/// lacks ground truth.
std::vector<std::string> share_names(const Table& table);

/// "0.5 [0.1, 0.9]", all multiplied by `scale`; without an interval only the value.
std::string with_interval(double value, const std::optional<Interval>& interval, int decimals,
                          double scale = 1.0);

/// "0.5 deg and 0.1 m of ", for a sentence.
std::string bounds_text(const SuccessBounds& bounds);

/// "pitch deg", for a title.
std::string title_of(const Measure& measure);

/// The rows over all sensors together.
template <class Row>
std::vector<Row> of_all_sensors(const std::vector<Row>& rows) {
  std::vector<Row> found;
  for (const Row& row : rows) {
    if (row.sensor.empty()) found.push_back(row);
  }
  return found;
}

inline constexpr std::array<std::size_t, 2> kDistances = {kRotation, kTranslation};

/// Adds a column for each of these measures, its `statistics` with `separator` in between.
template <std::size_t n>
void add_measures(View& view, const std::array<std::size_t, n>& measures,
                  const std::vector<std::string>& statistics, const std::string& separator = "") {
  for (const std::size_t k : measures) {
    std::string content;
    for (const std::string& statistic : statistics) {
      content += (content.empty() ? "<" : separator + "<") +
                 statistic_column(kMeasures[k], statistic).full_name() + ">";
    }
    view.columns.push_back({title_of(kMeasures[k]), content});
  }
}

// The rows of files, one at a time, because a table of all cells of many trials would be large.
// `use` receives the cells of each row; the functions return the columns.

using RowUse = std::function<void(const CellRow&)>;

/// The columns of a covariance: the upper triangle by rows, `c00` to `c55`, and the observability
/// of each degree of freedom, `roll` to `z`; in JSON below `path`, the whole matrix.
Columns<PoseCovariance> covariance_columns(const std::string& path = "");

/// Calls `use` with the cells of each row and returns the columns.
template <class Row>
std::vector<Column> use_rows(const Columns<Row>& columns, const std::vector<Row>& rows,
                             const RowUse& use) {
  for (const Row& row : rows) use(columns.cells(row));
  return columns.columns();
}

/// The rows of trials.csv, with "reason" as an additional last column.
std::vector<Column> trial_rows(const std::vector<TrialRecord>& records, const Summary& summary,
                               const RowUse& use);
/// The rows of summary.csv, comparison.csv and diagnostics.csv.
std::vector<Column> summary_rows(const Summary& summary, const RowUse& use);
std::vector<Column> comparison_rows(const Summary& summary, const RowUse& use);
std::vector<Column> diagnostic_rows(const std::vector<TrialRecord>& records,
                                    const StepNumbers& steps, const RowUse& use);
/// The rows of covariance.csv, one per trial with a covariance.
std::vector<Column> covariance_rows(const std::vector<TrialRecord>& records, const RowUse& use);

// The bytes of files.

/// trials.csv: a header and a row per record, in the given order. Error columns are empty without
/// ground truth, pose columns if the trial did not finish; quaternions have qw >= 0. The last
/// column is whether the trial agrees with the consensus of its scene in `summary`, that of the
/// records.
std::string trials_csv(const std::vector<TrialRecord>& records, const Summary& summary);

/// summary.csv: one row per variant and sensor.
std::string summary_csv(const Summary& summary);

/// extrinsics.json: for each variant and sensor the pose `T_reference_sensor` that the trials of
/// all scenes agree on, its spread and the number of agreeing trials, and the same for each scene.
/// `references` maps each sensor to the sensor that it is calibrated to.
std::string extrinsics_json(const Summary& summary,
                            const std::map<std::string, std::string>& references);

/// clouds.csv of `croon describe`: a row per cloud.
std::string clouds_csv(const std::vector<CloudDescription>& clouds);

/// The maximum number of scenes of a row listed in summary.json.
inline constexpr std::size_t kMaxJsonScenes = 100;

/// diagnostics.csv: a row per number reported by a step of a trial.
std::string diagnostics_csv(const std::vector<TrialRecord>& records, const StepNumbers& steps);

/// summary.json: the rows of summary.csv, each with its scenes, the reasons, and, if there are any,
/// the comparisons, kinds of scenes, loops, claims and medians of diagnostics. If a row has more
/// than `kMaxJsonScenes` scenes, "scenes" is null; trials.csv has their trials.
std::string summary_json(const Summary& summary, const std::vector<ClaimResult>& claims = {},
                         const std::vector<DiagnosticSummary>& diagnostics = {});

}  // namespace croon::experiments
