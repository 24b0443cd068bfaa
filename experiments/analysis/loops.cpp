#include "experiments/analysis/loops.hpp"

#include <algorithm>

namespace croon::experiments {

namespace {

/// The record of trial `trial`; null if there is none.
const TrialRecord* find_trial(const SceneRecords& records, int trial) {
  const auto is_before = [](const TrialRecord* record, int number) {
    return record->id.trial < number;
  };
  const auto found = std::lower_bound(records.begin(), records.end(), trial, is_before);
  return found != records.end() && (*found)->id.trial == trial ? *found : nullptr;
}

/// The loops of one variant and pair so far.
struct Loops {
  int all = 0;
  int closed = 0;
  std::vector<Measures> deviations;
};

void add_scene(Loops& loops, const SceneRecords& pair, const SceneRecords& source,
               const SceneRecords& target, const PoseBounds& bounds) {
  for (const TrialRecord* record : pair) {
    const TrialRecord* const of_source = find_trial(source, record->id.trial);
    const TrialRecord* const of_target = find_trial(target, record->id.trial);
    if (of_source == nullptr || of_target == nullptr) continue;
    ++loops.all;
    const RigidTransform* const T_target_source = usable_pose(*record);
    const RigidTransform* const T_reference_source = usable_pose(*of_source);
    const RigidTransform* const T_reference_target = usable_pose(*of_target);
    if (!T_target_source || !T_reference_source || !T_reference_target) continue;
    const RigidTransform around = *T_reference_target * *T_target_source;
    loops.closed += agree(around, *T_reference_source, bounds);
    loops.deviations.push_back(measures_of(pose_error(around, *T_reference_source)));
  }
}

}  // namespace

LoopClosure close_loops(const RecordGroups& groups, const std::string& variant,
                        const SensorPair& pair, const std::vector<std::string>& scenes,
                        const PoseBounds& bounds) {
  Loops loops;
  for (const std::string& scene : scenes) {
    const auto records_of = [&](const std::string& sensor) {
      const auto found = groups.find({variant, sensor, scene});
      return found == groups.end() ? SceneRecords() : found->second;
    };
    add_scene(loops, records_of(pair.name), records_of(pair.source), records_of(pair.target),
              bounds);
  }
  LoopClosure closure;
  closure.variant = variant;
  closure.pair = pair;
  closure.closed = share_of(loops.closed, loops.all);
  closure.counted = static_cast<int>(loops.deviations.size());
  if (closure.counted > 0) closure.statistics = statistics_of(loops.deviations);
  return closure;
}

}  // namespace croon::experiments
