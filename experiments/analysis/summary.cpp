#include "experiments/analysis/summary.hpp"

#include <algorithm>
#include <set>
#include <tuple>

namespace croon::experiments {

namespace {

RecordGroups grouped(const std::vector<TrialRecord>& records) {
  RecordGroups groups;
  for (const TrialRecord& record : records) {
    groups[{record.id.variant, record.id.sensor, record.id.scene}].push_back(&record);
  }
  for (auto& [key, group] : groups) {
    std::sort(group.begin(), group.end(),
              [](const TrialRecord* a, const TrialRecord* b) { return a->id.trial < b->id.trial; });
  }
  return groups;
}

void set_scene_kinds(std::vector<SummaryRow>& rows,
                     const std::map<std::string, std::string>& kinds) {
  for (SummaryRow& row : rows) {
    for (SceneSummary& scene : row.scenes) {
      const auto kind = kinds.find(scene.scene);
      if (kind != kinds.end()) scene.scene_kind = kind->second;
    }
  }
}

/// The trials of all `rows`, which are of one variant, in the scenes of one kind.
SceneKindSummary summary_of_kind(const std::vector<const SummaryRow*>& rows,
                                 const std::string& kind, const std::string& sensor) {
  std::vector<const SceneSummary*> scenes = scenes_of(rows);
  scenes.erase(std::remove_if(scenes.begin(), scenes.end(),
                              [&](const auto* scene) { return scene->scene_kind != kind; }),
               scenes.end());
  std::set<std::string> names;
  for (const SceneSummary* scene : scenes) names.insert(scene->scene);
  return {pooled(scenes), rows.front()->variant, kind, sensor, static_cast<int>(names.size())};
}

/// By variant, kind (alphabetically; scenes without one have the kind "") and sensor as in the
/// rows, all sensors together last. Empty if no scene has a kind.
std::vector<SceneKindSummary> summarise_scene_kinds(const Summary& summary) {
  std::vector<SceneKindSummary> summaries;
  bool has_kinds = false;
  for (const std::string& variant : variants_of(summary)) {
    const std::vector<const SummaryRow*> rows = rows_of(summary, variant);
    std::set<std::string> kinds;
    for (const SceneSummary* scene : scenes_of(rows)) kinds.insert(scene->scene_kind);
    has_kinds = has_kinds || kinds != std::set<std::string>{""};
    for (const std::string& kind : kinds) {
      for (const SummaryRow* row : rows) {
        SceneKindSummary of_sensor = summary_of_kind({row}, kind, row->sensor);
        if (of_sensor.scenes > 0) summaries.push_back(std::move(of_sensor));
      }
      summaries.push_back(summary_of_kind(rows, kind, ""));
    }
  }
  if (!has_kinds) summaries.clear();
  return summaries;
}

std::vector<ReasonCount> count_reasons(const std::vector<TrialRecord>& records) {
  std::map<std::tuple<std::string, Status, std::string>, int> counts;
  for (const TrialRecord& record : records) {
    if (!record.reason.empty()) ++counts[{record.id.variant, record.status, record.reason}];
  }
  std::vector<ReasonCount> reasons;
  for (const auto& [key, count] : counts) {
    reasons.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), count});
  }
  std::stable_sort(reasons.begin(), reasons.end(),
                   [](const ReasonCount& a, const ReasonCount& b) { return a.count > b.count; });
  return reasons;
}

/// The names that rows have, in their order.
std::vector<std::string> each_once(const Summary& summary, std::string SummaryRow::*name) {
  std::vector<std::string> names;
  for (const SummaryRow& row : summary.rows) {
    if (std::find(names.begin(), names.end(), row.*name) == names.end()) {
      names.push_back(row.*name);
    }
  }
  return names;
}

}  // namespace

std::vector<std::string> completed(std::vector<std::string> names,
                                   const std::vector<TrialRecord>& records,
                                   std::string TrialId::*name) {
  std::set<std::string> others;
  for (const TrialRecord& record : records) others.insert(record.id.*name);
  for (const std::string& other : others) {
    if (std::find(names.begin(), names.end(), other) == names.end()) names.push_back(other);
  }
  return names;
}

std::vector<std::string> variants_of(const Summary& summary) {
  return each_once(summary, &SummaryRow::variant);
}

std::vector<std::string> sensors_of(const Summary& summary) {
  return each_once(summary, &SummaryRow::sensor);
}

std::vector<const SummaryRow*> rows_of(const Summary& summary, const std::string& variant,
                                       const std::string& sensor) {
  std::vector<const SummaryRow*> rows;
  for (const SummaryRow& row : summary.rows) {
    if (row.variant == variant && (sensor.empty() || row.sensor == sensor)) rows.push_back(&row);
  }
  return rows;
}

Summary summarise(const std::vector<TrialRecord>& records, const SuccessBounds& bounds,
                  const ReportOrder& order) {
  const RecordGroups groups = grouped(records);
  const std::vector<std::string> scene_names = completed(order.scenes, records, &TrialId::scene);
  const std::vector<std::string> sensors = completed(order.sensors, records, &TrialId::sensor);
  const std::vector<std::string> variants = completed(order.variants, records, &TrialId::variant);
  Summary summary;
  summary.bounds = bounds;
  for (const std::string& variant : variants) {
    for (const std::string& sensor : sensors) {
      std::vector<SceneRecords> scenes;
      for (const std::string& scene : scene_names) {
        const auto group = groups.find({variant, sensor, scene});
        if (group != groups.end()) scenes.push_back(group->second);
      }
      if (!scenes.empty()) summary.rows.push_back(summary_row(scenes, pose_bounds(bounds)));
    }
  }
  set_scene_kinds(summary.rows, order.scene_kinds);
  summary.scene_kinds = summarise_scene_kinds(summary);
  if (variants.size() > 1) {
    summary.comparisons = compare_with_base(variants.front(), groups, summary.rows, bounds);
  }
  for (const std::string& variant : variants) {
    for (const SensorPair& pair : order.pairs) {
      const LoopClosure loop = close_loops(groups, variant, pair, scene_names, pose_bounds(bounds));
      if (loop.closed.trials > 0) summary.loops.push_back(loop);
    }
  }
  summary.reasons = count_reasons(records);
  return summary;
}

}  // namespace croon::experiments
