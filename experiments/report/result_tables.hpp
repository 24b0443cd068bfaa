#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/basin.hpp"
#include "experiments/analysis/claims.hpp"
#include "experiments/analysis/summary.hpp"
#include "experiments/report/table.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/pipeline/cloud_description.hpp"

namespace croon::experiments {

/// The columns of comparison.csv and of "comparisons" in summary.json; those of loops.csv; those of
/// clouds.csv; those of "claims" in summary.json.
Columns<Comparison> comparison_columns();
Columns<LoopClosure> loop_columns();
Columns<CloudDescription> cloud_columns();
Columns<ClaimResult> claim_columns();

// The bytes of files.

/// trials.csv: a header and a row per record in the order given. Error columns are empty without
/// truth, pose columns if the trial did not finish; quaternions have qw >= 0.
std::string trials_csv(const std::vector<TrialRecord>& records);

/// timings.csv: a header and a row per timing in the order given.
std::string timings_csv(const std::vector<TimingRow>& rows);

/// summary.csv: one row per variant and sensor.
std::string summary_csv(const Summary& summary);

/// summary_by_kind.csv: one row per variant, kind of scene and sensor, and one over all sensors,
/// whose name is "all".
std::string summary_by_kind_csv(const Summary& summary);

/// comparison.csv: one row per variant and sensor, and one over all sensors, whose name is "all".
/// "inf" is the error of a trial without a usable result.
std::string comparison_csv(const Summary& summary);

/// loops.csv: one row per variant and pair of sensors.
std::string loops_csv(const Summary& summary);

/// basin.csv: a row per variant, sensor ("all" for all together) and level.
std::string basin_csv(const Basin& basin);

/// clouds.csv of `croon describe`: a row per cloud.
std::string clouds_csv(const std::vector<CloudDescription>& clouds);

/// The most scenes of a row that summary.json lists.
inline constexpr std::size_t kMaxJsonScenes = 100;

/// summary.json: the rows of summary.csv, each with its scenes, the reasons, and the comparisons,
/// the kinds of scenes, the loops and the claims if there are some. If a row has more than
/// `kMaxJsonScenes` scenes, none is listed: "scenes" is null. trials.csv has their trials.
std::string summary_json(const Summary& summary, const std::vector<ClaimResult>& claims = {});

}  // namespace croon::experiments
