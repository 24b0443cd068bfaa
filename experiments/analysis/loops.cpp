#include "experiments/analysis/summary.hpp"

namespace croon::experiments {

LoopClosure close_loops(const RecordGroups& groups, const std::string& variant,
                        const SensorPair& pair, const std::vector<std::string>& scenes,
                        const PoseBounds& bounds) {
  int loops = 0;
  int closed = 0;
  std::vector<Measures> deviations;
  for (const std::string& scene : scenes) {
    for (const TrialRecord* record : groups.of(variant, pair.name, scene)) {
      const int trial = record->id.trial;
      const auto* const source = find_trial(groups.of(variant, pair.source, scene), trial);
      const auto* const target = find_trial(groups.of(variant, pair.target, scene), trial);
      if (!source || !target) continue;
      ++loops;
      const RigidTransform* const T_target_source = usable_pose(*record);
      const RigidTransform* const T_reference_source = usable_pose(*source);
      const RigidTransform* const T_reference_target = usable_pose(*target);
      if (!T_target_source || !T_reference_source || !T_reference_target) continue;
      const RigidTransform around = *T_reference_target * *T_target_source;
      closed += agree(around, *T_reference_source, bounds);
      deviations.push_back(measures_of(pose_error(around, *T_reference_source)));
    }
  }
  LoopClosure closure{
      variant, pair, share_of(closed, loops), static_cast<int>(deviations.size()), {}};
  if (closure.counted > 0) closure.statistics = statistics_of(deviations);
  return closure;
}

}  // namespace croon::experiments
