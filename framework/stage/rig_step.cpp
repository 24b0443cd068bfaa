#include "framework/stage/rig_step.hpp"

#include <sstream>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/geometry/length_bound.hpp"

namespace croon {
namespace {

void require_usable(const Cloud& cloud) {
  if (cloud.empty()) throw StageError("a cloud is empty");
  for (const Eigen::Vector3f& point : cloud.points()) {
    // Negated, so that NaN is refused too.
    if ((point.array().abs() <= static_cast<float>(kLargestCoordinate_m)).all()) continue;
    std::ostringstream message;
    message << "a point at (" << point.x() << ", " << point.y() << ", " << point.z()
            << ") m is farther off than " << kLargestCoordinate_m << " m";
    throw StageError(message.str());
  }
}

}  // namespace

Estimate RigStep::advance(Estimate estimate, Rng& rng) const {
  const TrialName name = estimate.trial ? *estimate.trial : TrialName();
  std::vector<RigEstimate> rig;
  rig.push_back({name.scene, "", name.sensor, std::move(estimate)});
  adjust(rig, rng);
  if (!rig.front().failure.empty()) throw StageError(rig.front().failure);
  return std::move(rig.front().estimate);
}

void require_usable_clouds(const Estimate& estimate) {
  require_usable(*estimate.target);
  require_usable(*estimate.source);
}

}  // namespace croon
