#pragma once

#include <optional>
#include <string>

#include "experiments/analysis/trial_summary.hpp"
#include "experiments/report/table.hpp"
#include "experiments/report/view.hpp"

namespace croon::experiments {

// Columns that several tables have in common, each described once. In JSON, the values of
// `statistics_columns` are below "statistics", and so on.

/// The column "sensor" of an object with that member; empty for all sensors.
template <class Row>
void add_sensor(Columns<Row>& columns) {
  columns.add({"sensor", "", "", 0, Better::neither, false, true},
              [](const Row& row) { return nothing_if_empty(row.sensor); });
}

/// Ratio, low and high end of a share called `name`.
Columns<Share> share_columns(const std::string& name);

/// Trials by outcome, the shares of success and agreement.
Columns<TrialSummary> outcome_columns();

/// Every statistic of every measure.
Columns<std::optional<StatisticsTable>> statistics_columns();

/// The trials that count, and their statistics.
Columns<TrialSummary> counted_columns();

/// Values of the DOFs that are called `name`, "roll_within_scene_std_deg".
Columns<std::optional<DofValues>> dof_columns(const std::string& name);

/// Translation and quaternion (qw >= 0), in JSON below `path`.
Columns<std::optional<RigidTransform>> pose_columns(const std::string& path = "");

/// "0.5 deg and 0.1 m of ", for a sentence.
std::string bounds_text(const SuccessBounds& bounds);

/// "pitch_mean_deg".
std::string column_name(const Measure& measure, const std::string& statistic);

/// `content` of a view for one measure: "<mean>" becomes "<pitch_mean_deg>".
std::string content_of(const Measure& measure, std::string content);

/// Adds a column for each DOF, in the order of the paper; see `content_of`.
void add_dofs(View& view, const std::string& content);

}  // namespace croon::experiments
