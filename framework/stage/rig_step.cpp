#include "framework/stage/rig_step.hpp"

#include <map>
#include <sstream>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/threads.hpp"
#include "framework/geometry/length_bound.hpp"

namespace croon {
namespace {

void require_usable(const Cloud& cloud) {
  if (cloud.empty()) throw StageError("a cloud is empty");
  for (const Eigen::Vector3f& point : cloud.points()) {
    // Negated, so that NaN is refused too.
    if ((point.array().abs() <= static_cast<float>(kMaxCoordinate_m)).all()) continue;
    std::ostringstream message;
    message << "a point at (" << point.x() << ", " << point.y() << ", " << point.z()
            << ") m exceeds the maximum coordinate of " << kMaxCoordinate_m << " m";
    throw StageError(message.str());
  }
}

}  // namespace

Estimate RigStep::advance(Estimate estimate, Rng& rng) const {
  std::vector<RigEstimate> rig;
  rig.push_back({"", "", "", std::move(estimate)});
  adjust(rig, rng);
  if (!rig.front().failure.empty()) throw StageError(rig.front().failure);
  return std::move(rig.front().estimate);
}

void require_usable_clouds(const Estimate& estimate) {
  require_usable(*estimate.target);
  require_usable(*estimate.source);
}

std::vector<RigGroup> rig_groups(std::vector<RigEstimate>& rig,
                                 const std::function<std::optional<RigKey>(RigEstimate&)>& key_of) {
  std::map<RigKey, RigGroup> by_key;
  for (RigEstimate& one : rig) {
    try {
      if (const std::optional<RigKey> key = key_of(one)) by_key[*key].push_back(&one);
    } catch (const StageError& error) {
      one.failure = error.what();
    }
  }
  std::vector<RigGroup> groups;
  for (auto& [key, group] : by_key) groups.push_back(std::move(group));
  return groups;
}

void for_each_group(const std::vector<RigGroup>& groups,
                    const std::function<void(const RigGroup&)>& use) {
  for_each_in_parallel(groups.size(), [&](std::size_t i) {
    try {
      use(groups[i]);
    } catch (const StageError& error) {
      for (RigEstimate* const one : groups[i]) {
        if (one->failure.empty()) one->failure = error.what();
      }
    }
  });
}

}  // namespace croon
