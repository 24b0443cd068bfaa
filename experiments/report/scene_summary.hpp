#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "experiments/report/summary.hpp"
#include "framework/geometry/pose_mean.hpp"

namespace croon::experiments {

/// The trials of one variant, sensor and scene, by trial.
using SceneRecords = std::vector<const TrialRecord*>;

/// The records of each (variant, sensor, scene).
using RecordGroups = std::map<std::tuple<std::string, std::string, std::string>, SceneRecords>;

/// The bounds in the units that geometry uses.
PoseBounds pose_bounds(const SuccessBounds& bounds);

/// `count` of `trials` with its interval.
Share share_of(int count, int trials);

/// The pose of a trial that came to its end and is not rejected; else null.
const RigidTransform* usable_pose(const TrialRecord& record);

/// Adds `outcomes` to `sum`.
void add_outcomes(Outcomes& sum, const Outcomes& outcomes);

/// The statistics of each measure; `deviations` must not be empty.
StatisticsTable statistics_of(const std::vector<Measures>& deviations);

/// The outcomes of a scene and what its successful trials agree on: all but the deviations.
SceneSummary start_scene_summary(const SceneRecords& records, const PoseBounds& bounds);

/// The deviations of the trials that count (see `SummaryRow`), from the truth or from `consensus`.
void add_deviations(SceneSummary& scene, const SceneRecords& records, Reference reference,
                    const std::optional<RigidTransform>& consensus, const PoseBounds& bounds);

/// See `SummaryRow::within_scene_std`.
std::optional<std::array<double, kDofs>> within_scene_std(const std::vector<SceneSummary>& scenes);

/// See `SummaryRow::across_scenes_std`; the rest of `row` is complete.
std::optional<std::array<double, kDofs>> across_scenes_std(const SummaryRow& row);

}  // namespace croon::experiments
