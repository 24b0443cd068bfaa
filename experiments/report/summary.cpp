#include "experiments/report/summary.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>

#include "experiments/report/compare_variants.hpp"
#include "experiments/report/kind_summary.hpp"
#include "experiments/report/loop_closure.hpp"
#include "experiments/report/scene_summary.hpp"
#include "framework/geometry/pose_mean.hpp"

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

/// Truth where one trial has it, else what the scenes agree on.
Reference reference_of(const std::vector<SceneRecords>& scenes, bool has_consensus) {
  for (const SceneRecords& scene : scenes) {
    for (const TrialRecord* record : scene) {
      if (record->error) return Reference::truth;
    }
  }
  return has_consensus ? Reference::consensus : Reference::none;
}

/// What all scenes came to; `row.scenes` are complete.
void sum_up_scenes(SummaryRow& row) {
  int agreeing = 0;
  std::vector<Measures> deviations;
  for (const SceneSummary& scene : row.scenes) {
    add_outcomes(row.outcomes, scene.outcomes);
    agreeing += scene.agreement.count;
    deviations.insert(deviations.end(), scene.deviations.begin(), scene.deviations.end());
  }
  row.success = share_of(row.outcomes.success, row.outcomes.trials);
  row.agreement = share_of(agreeing, row.outcomes.trials);
  row.counted = static_cast<int>(deviations.size());
  if (row.counted > 0) row.statistics = statistics_of(deviations);
  row.within_scene_std = within_scene_std(row.scenes);
  row.across_scenes_std = across_scenes_std(row);
}

SummaryRow summarise_row(const std::vector<SceneRecords>& scenes, const PoseBounds& bounds) {
  SummaryRow row;
  row.variant = scenes.front().front()->id.variant;
  row.sensor = scenes.front().front()->id.sensor;
  std::vector<RigidTransform> consensus;
  for (const SceneRecords& records : scenes) {
    row.scenes.push_back(start_scene_summary(records, bounds));
    if (row.scenes.back().consensus) consensus.push_back(*row.scenes.back().consensus);
  }
  if (!consensus.empty()) row.consensus = consensus_pose(consensus, bounds);
  row.reference = reference_of(scenes, row.consensus.has_value());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    add_deviations(row.scenes[i], scenes[i], row.reference, row.consensus, bounds);
  }
  sum_up_scenes(row);
  return row;
}

void set_kinds(std::vector<SummaryRow>& rows, const std::map<std::string, std::string>& kinds) {
  for (SummaryRow& row : rows) {
    for (SceneSummary& scene : row.scenes) {
      const auto kind = kinds.find(scene.scene);
      if (kind != kinds.end()) scene.kind = kind->second;
    }
  }
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
  std::vector<std::string> others;
  for (const TrialRecord& record : records) others.push_back(record.id.*name);
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
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

const char* reference_name(Reference reference) {
  switch (reference) {
    case Reference::truth:
      return "truth";
    case Reference::consensus:
      return "consensus";
    case Reference::none:
      return "none";
  }
  throw std::logic_error("a reference that does not exist");
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
      if (!scenes.empty()) summary.rows.push_back(summarise_row(scenes, pose_bounds(bounds)));
    }
  }
  set_kinds(summary.rows, order.kinds);
  summary.kinds = summarise_kinds(summary.rows);
  if (variants.size() > 1) {
    summary.comparisons = compare_with_base(variants.front(), groups, summary.rows, bounds);
  }
  summary.loops =
      close_loops(groups, {variants, sensors, scene_names, {}, order.pairs}, pose_bounds(bounds));
  summary.reasons = count_reasons(records);
  return summary;
}

}  // namespace croon::experiments
