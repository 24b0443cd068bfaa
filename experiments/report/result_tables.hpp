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

/// The column "sensor" of an object with that member; empty for all sensors.
template <class Row>
void add_sensor(Columns<Row>& columns) {
  columns.add({"sensor", "", "", 0, Better::neither, false, true},
              [](const Row& row) { return nothing_if_empty(row.sensor); });
}

/// The column "pitch_mean_deg" of a measure and a statistic; `path` as in `Column`.
Column statistic_column(const Measure& measure, const std::string& statistic,
                        const std::string& path = "");

/// Values of the DOFs that are called `name`, "roll_within_scene_std_deg".
Columns<DofValues> dof_columns(const std::string& name);

/// Variant, scene, sensor and number of a trial.
Columns<TrialId> id_columns();

/// The ends of an interval that may not be there.
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

/// A pose that trials agree on, as extrinsics.json has it.
struct AgreedPose {
  std::optional<RigidTransform> pose;  ///< `T_reference_sensor`; std::nullopt if no two agree.
  int trials = 0;                      ///< All, those without a pose too.
  Agreeing agreeing;
  std::optional<PoseCovariance> covariance;  ///< If the poses that agree have one.
};

/// What all scenes agree on, and what the trials of one scene do.
AgreedPose agreed_pose(const SummaryRow& row);
AgreedPose agreed_pose(const SceneSummary& scene);

/// Matrix, translation, quaternion (x, y, z, w with w >= 0), roll, pitch and yaw
/// (R = Rz(yaw) Ry(pitch) Rx(roll)), how many trials agree, and their root mean square distances.
Columns<AgreedPose> agreed_pose_columns();

/// The columns of comparison.csv and of "comparisons" in summary.json; those of loops.csv; those of
/// clouds.csv; those of "claims" and of "reasons" in summary.json.
Columns<Comparison> comparison_columns();
Columns<LoopClosure> loop_columns();
Columns<CloudDescription> cloud_columns();
Columns<ClaimResult> claim_columns();
Columns<ReasonCount> reason_columns();
/// Those of "frames" in summary.json.
Columns<FrameSummary> frame_columns();

/// Whether a row of a table with a column "reference" has this one.
bool has_deviations_from(const Table& table, DeviationsFrom from);

/// The shares that a table with a column "reference" shows: "success", and "agreement" if a row has
/// no truth.
std::vector<std::string> share_names(const Table& table);

/// "0.5 deg and 0.1 m of ", for a sentence.
std::string bounds_text(const SuccessBounds& bounds);

/// "pitch deg", for a title.
std::string title_of(const Measure& measure);

/// `content` of a view for one measure: "<mean>" becomes "<pitch_mean_deg>".
std::string content_of(const Measure& measure, std::string content);

inline constexpr std::array<std::size_t, 2> kDistances = {kRotation, kTranslation};

/// Adds a column for each of these of `kMeasures`; see `content_of`.
template <std::size_t n>
void add_measures(View& view, const std::array<std::size_t, n>& measures,
                  const std::string& content) {
  for (const std::size_t k : measures) {
    view.columns.push_back({title_of(kMeasures[k]), content_of(kMeasures[k], content)});
  }
}

// The rows of files, one by one, for those who keep them in another form: a table of all cells of
// many trials would be large. `use` gets the cells of each row, with the columns that are returned.

using RowUse = std::function<void(const CellRow&)>;

/// The columns of a covariance: the upper triangle by rows, `c00` to `c55`, and the words of the
/// degrees of freedom, `roll` to `z`; in JSON below `path`, the whole matrix.
Columns<PoseCovariance> covariance_columns(const std::string& path = "");

/// The general case.
template <class Row>
std::vector<Column> use_rows(const Columns<Row>& columns, const std::vector<Row>& rows,
                             const RowUse& use) {
  for (const Row& row : rows) use(columns.cells(row));
  return columns.columns();
}

/// Those of trials.csv, and "reason" as the last column.
std::vector<Column> trial_rows(const std::vector<TrialRecord>& records, const Summary& summary,
                               const RowUse& use);
/// Those of summary.csv, comparison.csv and diagnostics.csv.
std::vector<Column> summary_rows(const Summary& summary, const RowUse& use);
std::vector<Column> comparison_rows(const Summary& summary, const RowUse& use);
std::vector<Column> diagnostic_rows(const std::vector<TrialRecord>& records,
                                    const StepNumbers& steps, const RowUse& use);
/// Those of covariance.csv.
std::vector<Column> covariance_rows(const std::vector<TrialRecord>& records, const RowUse& use);

// The bytes of files.

/// trials.csv: a header and a row per record in the order given. Error columns are empty without
/// truth, pose columns if the trial did not finish; quaternions have qw >= 0. The last column is
/// whether the trial agrees with the consensus of its scene in `summary`, which is of the records.
std::string trials_csv(const std::vector<TrialRecord>& records, const Summary& summary);

/// timings.csv: a header and a row per timing in the order given.
std::string timings_csv(const std::vector<TimingRow>& rows);

/// summary.csv: one row per variant and sensor.
std::string summary_csv(const Summary& summary);

/// summary_by_kind.csv: one row per variant, kind of scene and sensor, and one over all sensors,
/// whose name is "all".
std::string summary_by_kind_csv(const Summary& summary);

/// extrinsics.json: per variant and sensor the pose `T_reference_sensor` that the trials of all
/// scenes agree on, its spread and how many agree, and the same for each scene. `references` has
/// the name of the sensor that each is calibrated to.
std::string extrinsics_json(const Summary& summary,
                            const std::map<std::string, std::string>& references);

/// comparison.csv: one row per variant and sensor, and one over all sensors, whose name is "all".
/// "inf" is the error of a trial without a usable result.
std::string comparison_csv(const Summary& summary);

/// comparison_by_dof.csv: the same for the size of the error in each degree of freedom.
std::string comparison_by_dof_csv(const Summary& summary);

/// loops.csv: one row per variant and pair of sensors.
std::string loops_csv(const Summary& summary);

/// basin.csv: a row per variant, sensor ("all" for all together) and level.
std::string basin_csv(const Basin& basin);

/// success_curve.csv: a row per variant, sensor ("all" for all together), what is bounded
/// (rotation, translation or both) and threshold; a bound that is not there is empty.
std::string success_curve_csv(const SuccessCurve& curve);

/// verdicts.csv: a row per variant, sensor ("all" for all together) and threshold, rotation and
/// translation together, from which on a pose is wrong.
std::string verdicts_csv(const Verdicts& verdicts);

/// covariance.csv: a row per trial with a covariance.
std::string covariance_csv(const std::vector<TrialRecord>& records);

/// coverage.csv: a row per variant, sensor ("all" for all together), degree of freedom ("all" for
/// the ellipsoid of all six) and level.
std::string coverage_csv(const Coverage& coverage);

/// nees.csv: a row per variant and sensor ("all" for all together).
std::string nees_csv(const Coverage& coverage);

/// clouds.csv of `croon describe`: a row per cloud.
std::string clouds_csv(const std::vector<CloudDescription>& clouds);

/// The most scenes of a row that summary.json lists.
inline constexpr std::size_t kMaxJsonScenes = 100;

/// diagnostics.csv: a row per number that a step of a trial reported of its work.
std::string diagnostics_csv(const std::vector<TrialRecord>& records, const StepNumbers& steps);

/// summary.json: the rows of summary.csv, each with its scenes, the reasons, and the comparisons,
/// the kinds of scenes, the loops, the claims and the medians of diagnostics if there are some. If
/// a row has more than `kMaxJsonScenes` scenes, none is listed: "scenes" is null. trials.csv has
/// their trials.
std::string summary_json(const Summary& summary, const std::vector<ClaimResult>& claims = {},
                         const std::vector<DiagnosticSummary>& diagnostics = {});

}  // namespace croon::experiments
