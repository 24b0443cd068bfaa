#include "experiments/analysis/summary.hpp"

#include <algorithm>
#include <set>

namespace croon::experiments {
namespace {

/// The distinct names of the rows, in their order.
std::vector<std::string> each_once(const Summary& summary, std::string SummaryRow::*name) {
  std::vector<std::string> names;
  for (const SummaryRow& row : summary.rows) {
    if (std::find(names.begin(), names.end(), row.*name) == names.end()) {
      names.push_back(row.*name);
    }
  }
  return names;
}

/// Summarises the trials of all `rows`, which are of one variant, in the scenes of one kind.
SceneKindSummary summary_of_kind(const Rows& rows, const std::string& kind,
                                 const std::string& sensor) {
  std::vector<const SceneSummary*> scenes;
  for (const SceneSummary* scene : scenes_of(rows)) {
    if (scene->scene_kind == kind) scenes.push_back(scene);
  }
  return {pooled(scenes), rows.front()->variant, kind, sensor};
}

/// By variant, kind (alphabetically; "" for scenes without a kind) and sensor as in the rows, all
/// sensors together last. Empty if no scene has a kind.
std::vector<SceneKindSummary> summarise_scene_kinds(const Summary& summary) {
  std::vector<SceneKindSummary> summaries;
  bool has_kinds = false;
  for (const std::string& variant : variants_of(summary)) {
    const Rows rows = rows_of(summary, variant);
    std::set<std::string> kinds;
    for (const SceneSummary* scene : scenes_of(rows)) kinds.insert(scene->scene_kind);
    has_kinds = has_kinds || kinds != std::set<std::string>{""};
    for (const std::string& kind : kinds) {
      for (const SummaryRow* row : rows) {
        SceneKindSummary of_sensor = summary_of_kind({row}, kind, row->sensor);
        if (of_sensor.scene_count > 0) summaries.push_back(std::move(of_sensor));
      }
      summaries.push_back(summary_of_kind(rows, kind, ""));
    }
  }
  if (!has_kinds) summaries.clear();
  return summaries;
}

/// See `Summary::frames`.
std::vector<FrameSummary> summarise_frames(const Summary& summary) {
  std::vector<FrameSummary> summaries;
  for (const std::string& variant : variants_of(summary)) {
    const Rows rows = rows_of(summary, variant);
    if (rows.size() < 2 || !have_truth(rows)) continue;
    summaries.push_back({variant, successful_frames(rows)});
  }
  return summaries;
}

std::vector<ReasonCount> count_reasons(const std::vector<TrialRecord>& records) {
  std::map<std::tuple<std::string, Status, std::string>, int> counts;
  for (const TrialRecord& record : records) {
    if (!record.reason.empty()) ++counts[{record.id.variant, record.status, record.reason}];
  }
  std::vector<ReasonCount> reasons;
  for (const auto& [key, count] : counts) {
    const auto& [variant, status, reason] = key;
    reasons.push_back({variant, status, reason, count});
  }
  std::stable_sort(reasons.begin(), reasons.end(),
                   [](const ReasonCount& a, const ReasonCount& b) { return a.count > b.count; });
  return reasons;
}

}  // namespace

std::vector<std::string> completed(std::vector<std::string> names,
                                   const std::vector<TrialRecord>& records,
                                   std::string TrialId::*name) {
  std::set<std::string> others;
  for (const TrialRecord& record : records) others.insert(record.id.*name);
  for (const std::string& known : names) others.erase(known);
  names.insert(names.end(), others.begin(), others.end());
  return names;
}

std::vector<std::string> variants_of(const Summary& summary) {
  return each_once(summary, &SummaryRow::variant);
}

std::vector<std::string> sensors_of(const Summary& summary) {
  return each_once(summary, &SummaryRow::sensor);
}

Rows rows_of(const Summary& summary, const std::string& variant, const std::string& sensor) {
  Rows rows;
  for (const SummaryRow& row : summary.rows) {
    if (row.variant == variant && (sensor.empty() || row.sensor == sensor)) rows.push_back(&row);
  }
  return rows;
}

RecordGroups::RecordGroups(const std::vector<TrialRecord>& records) {
  for (const TrialRecord& record : records) {
    groups_[{record.id.variant, record.id.sensor, record.id.scene}].push_back(&record);
  }
  for (auto& [key, group] : groups_) {
    std::sort(group.begin(), group.end(),
              [](const TrialRecord* a, const TrialRecord* b) { return a->id.trial < b->id.trial; });
  }
}

const SceneRecords& RecordGroups::of(const std::string& variant, const std::string& sensor,
                                     const std::string& scene) const {
  static const SceneRecords none;
  const auto found = groups_.find({variant, sensor, scene});
  return found == groups_.end() ? none : found->second;
}

Summary summarise(const std::vector<TrialRecord>& records, const SuccessBounds& success,
                  const ReportOrder& order) {
  const RecordGroups groups(records);
  const PoseBounds bounds = pose_bounds(success);
  const std::vector<std::string> scene_names = completed(order.scenes, records, &TrialId::scene);
  const std::vector<std::string> sensors = completed(order.sensors, records, &TrialId::sensor);
  const std::vector<std::string> variants = completed(order.variants, records, &TrialId::variant);
  std::map<std::string, std::string> kinds = order.scene_kinds;
  Summary summary;
  summary.bounds = success;
  for (const std::string& variant : variants) {
    for (const std::string& sensor : sensors) {
      std::vector<SceneRecords> scenes;
      for (const std::string& scene : scene_names) {
        const SceneRecords& group = groups.of(variant, sensor, scene);
        if (!group.empty()) scenes.push_back(group);
      }
      if (scenes.empty()) continue;
      SummaryRow& row = summary.rows.emplace_back(
          summary_row(scenes, bounds, order.without_truth.count(sensor) > 0));
      for (SceneSummary& scene : row.scenes) scene.scene_kind = kinds[scene.scene];
    }
    for (const SensorPair& pair : order.pairs) {
      LoopClosure loop =
          close_loops(groups, rows_of(summary, variant), variant, pair, scene_names, bounds);
      if (loop.closed.trials > 0) summary.loops.push_back(std::move(loop));
    }
  }
  summary.scene_kinds = summarise_scene_kinds(summary);
  summary.frames = summarise_frames(summary);
  if (!variants.empty()) compare_with_base(variants.front(), summary, groups, bounds);
  summary.curve = success_curve(summary, groups);
  summary.below_best = below_best(summary, groups, bounds);
  summary.reasons = count_reasons(records);
  return summary;
}

}  // namespace croon::experiments
