#include "framework/stage/rig_step.hpp"

#include <utility>

#include "framework/base/error.hpp"

namespace croon {

Estimate RigStep::advance(Estimate estimate, Rng& rng) const {
  const TrialName name = estimate.trial ? *estimate.trial : TrialName();
  std::vector<RigEstimate> rig;
  rig.push_back({name.scene, "", name.sensor, std::move(estimate)});
  adjust(rig, rng);
  if (!rig.front().failure.empty()) throw StageError(rig.front().failure);
  return std::move(rig.front().estimate);
}

}  // namespace croon
