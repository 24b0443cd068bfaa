#include <algorithm>

#include "experiments/analysis/summary.hpp"

namespace croon::experiments {
namespace {

/// The poses of a loop; null for an unknown pose.
struct Links {
  const RigidTransform* T_target_source = nullptr;
  const RigidTransform* T_reference_source = nullptr;
  const RigidTransform* T_reference_target = nullptr;

  bool are_known() const { return T_target_source && T_reference_source && T_reference_target; }
};

LoopGap gap_of(const Links& links, const PoseBounds& bounds) {
  const RigidTransform around = *links.T_reference_target * *links.T_target_source;
  return {agree(around, *links.T_reference_source, bounds),
          measures_of(pose_error(around, *links.T_reference_source))};
}

/// The row of a sensor; null if there is none.
const SummaryRow* find_row(const Rows& rows, const std::string& sensor) {
  const auto is_it = [&](const SummaryRow* row) { return row->sensor == sensor; };
  const auto found = std::find_if(rows.begin(), rows.end(), is_it);
  return found == rows.end() ? nullptr : *found;
}

const SceneSummary* find_scene(const SummaryRow& row, const std::string& name) {
  const auto is_it = [&](const SceneSummary& scene) { return scene.scene == name; };
  const auto found = std::find_if(row.scenes.begin(), row.scenes.end(), is_it);
  return found == row.scenes.end() ? nullptr : &*found;
}

/// Closes the loop over the poses that all scenes agree on, and for each scene the loop over the
/// poses that its trials agree on.
void close_over_agreed_poses(LoopClosure& closure, const Rows& rows, const PoseBounds& bounds) {
  const SummaryRow* const pair = find_row(rows, closure.pair.name);
  const SummaryRow* const source = find_row(rows, closure.pair.source);
  const SummaryRow* const target = find_row(rows, closure.pair.target);
  if (!pair || !source || !target) return;
  const Links agreed = {agreed_consensus(*pair), agreed_consensus(*source),
                        agreed_consensus(*target)};
  if (agreed.are_known()) closure.agreed = gap_of(agreed, bounds);
  for (const SceneSummary& scene : pair->scenes) {
    const SceneSummary* const of_source = find_scene(*source, scene.scene);
    const SceneSummary* const of_target = find_scene(*target, scene.scene);
    if (!of_source || !of_target) continue;
    const Links links = {agreed_consensus(scene), agreed_consensus(*of_source),
                         agreed_consensus(*of_target)};
    ++closure.scenes;
    closure.scenes_closed += links.are_known() && gap_of(links, bounds).is_closed;
  }
}

}  // namespace

LoopClosure close_loops(const RecordGroups& groups, const Rows& rows, const std::string& variant,
                        const SensorPair& pair, const std::vector<std::string>& scenes,
                        const PoseBounds& bounds) {
  SceneCounts counts;
  std::vector<Measures> deviations;
  for (const std::string& scene : scenes) {
    for (const TrialRecord* record : groups.of(variant, pair.name, scene)) {
      const int trial = record->id.trial;
      const auto* const source = find_trial(groups.of(variant, pair.source, scene), trial);
      const auto* const target = find_trial(groups.of(variant, pair.target, scene), trial);
      if (!source || !target) continue;
      const Links links = {usable_pose(*record), usable_pose(*source), usable_pose(*target)};
      const std::optional<LoopGap> gap =
          links.are_known() ? std::optional<LoopGap>(gap_of(links, bounds)) : std::nullopt;
      counts.add(scene, gap && gap->is_closed, 1);
      if (gap) deviations.push_back(gap->deviations);
    }
  }
  LoopClosure closure;
  closure.variant = variant;
  closure.pair = pair;
  closure.closed = counts.share();
  closure.counted = static_cast<int>(deviations.size());
  if (closure.counted > 0) closure.statistics = statistics_of(deviations);
  close_over_agreed_poses(closure, rows, bounds);
  return closure;
}

}  // namespace croon::experiments
