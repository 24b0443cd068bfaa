#include "experiments/report/loop_closure.hpp"

#include <algorithm>

namespace croon::experiments {

namespace {

/// The trials that are one link of the loops of a scene.
class Link {
 public:
  Link(const RecordGroups& groups, const std::string& variant, const std::string& sensor,
       const std::string& scene) {
    const auto found = groups.find({variant, sensor, scene});
    if (found != groups.end()) records_ = &found->second;
  }

  /// Trial `trial`; null where there is none.
  const TrialRecord* at(int trial) const {
    const auto is_before = [](const TrialRecord* record, int number) {
      return record->id.trial < number;
    };
    const auto found = std::lower_bound(records().begin(), records().end(), trial, is_before);
    return found != records().end() && (*found)->id.trial == trial ? *found : nullptr;
  }

  const SceneRecords& records() const {
    static const SceneRecords kNone;
    return records_ == nullptr ? kNone : *records_;
  }

 private:
  const SceneRecords* records_ = nullptr;
};

/// What the loops of one variant and pair came to so far.
struct Loops {
  int all = 0;
  int closed = 0;
  std::vector<Measures> deviations;
};

void add_scene(Loops& loops, const Link& pair, const Link& source, const Link& target,
               const PoseBounds& bounds) {
  for (const TrialRecord* record : pair.records()) {
    const TrialRecord* const of_source = source.at(record->id.trial);
    const TrialRecord* const of_target = target.at(record->id.trial);
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

LoopClosure closure_of(const std::string& variant, const SensorPair& pair, const Loops& loops) {
  LoopClosure closure;
  closure.variant = variant;
  closure.pair = pair;
  closure.closed = share_of(loops.closed, loops.all);
  closure.counted = static_cast<int>(loops.deviations.size());
  if (closure.counted > 0) closure.statistics = statistics_of(loops.deviations);
  return closure;
}

}  // namespace

std::vector<LoopClosure> close_loops(const RecordGroups& groups, const ReportOrder& order,
                                     const PoseBounds& bounds) {
  std::vector<LoopClosure> closures;
  for (const std::string& variant : order.variants) {
    for (const SensorPair& pair : order.pairs) {
      Loops loops;
      for (const std::string& scene : order.scenes) {
        const auto link = [&](const std::string& sensor) {
          return Link(groups, variant, sensor, scene);
        };
        add_scene(loops, link(pair.name), link(pair.source), link(pair.target), bounds);
      }
      if (loops.all > 0) closures.push_back(closure_of(variant, pair, loops));
    }
  }
  return closures;
}

}  // namespace croon::experiments
