#include "experiments/analysis/paired_trials.hpp"

#include <limits>

#include "framework/base/angles.hpp"

namespace croon::experiments {

namespace {

struct TrialResult {
  double rotation_deg = std::numeric_limits<double>::infinity();
  double translation_m = std::numeric_limits<double>::infinity();
  bool is_won = false;
};

TrialResult result_of(const TrialRecord& record, const SceneSummary& scene,
                      const PoseBounds& bounds) {
  const RigidTransform* const pose = usable_pose(record);
  if (pose == nullptr || (!record.error && !scene.consensus)) return {};
  const PoseError error = record.error ? *record.error : pose_error(*pose, *scene.consensus);
  // Without truth every trial that finished is a success: it must agree too, as in the tables.
  const bool is_won =
      record.status == Status::success && (record.error || agree(*pose, *scene.consensus, bounds));
  return {deg_from_rad(error.rotation_rad), error.translation_m, is_won};
}

void add(Pairs& to, double base, double variant) {
  to.base.push_back(base);
  to.variant.push_back(variant);
}

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

void add_pairs(PairedTrials& to, std::size_t scene, const SceneTrials& base,
               const SceneTrials& variant, const PoseBounds& bounds) {
  auto other = base.records.begin();
  for (const TrialRecord* record : variant.records) {
    while (other != base.records.end() && (*other)->id.trial < record->id.trial) ++other;
    if (other == base.records.end()) return;
    if ((*other)->id.trial != record->id.trial) continue;
    const TrialResult before = result_of(**other, base.summary, bounds);
    const TrialResult after = result_of(*record, variant.summary, bounds);
    to.scenes.push_back(scene);
    add(to.rotation_deg, before.rotation_deg, after.rotation_deg);
    add(to.translation_m, before.translation_m, after.translation_m);
    to.success.push_back((after.is_won ? 1.0 : 0.0) - (before.is_won ? 1.0 : 0.0));
  }
}

void append(PairedTrials& to, const PairedTrials& from) {
  append(to.scenes, from.scenes);
  append(to.rotation_deg.base, from.rotation_deg.base);
  append(to.rotation_deg.variant, from.rotation_deg.variant);
  append(to.translation_m.base, from.translation_m.base);
  append(to.translation_m.variant, from.translation_m.variant);
  append(to.success, from.success);
}

}  // namespace croon::experiments
