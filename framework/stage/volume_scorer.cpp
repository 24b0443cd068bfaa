#include "framework/stage/volume_scorer.hpp"

#include "framework/base/threads.hpp"

namespace croon {

std::vector<OccupiedVolume> VolumeFunction::at(const std::vector<RigidTransform>& poses) const {
  std::vector<OccupiedVolume> volumes(poses.size());
  const auto compute = [&](std::size_t i) { volumes[i] = of_pose_(poses[i]); };
  if (poses_ == Poses::one_by_one || poses.size() < 2) {
    for (std::size_t i = 0; i < poses.size(); ++i) compute(i);
  } else {
    // Isolated: a thread that waits inside a trial must not start the work of another trial.
    tbb::this_task_arena::isolate([&] { for_each_in_parallel(poses.size(), compute); });
  }
  return volumes;
}

PoseCost volume_cost(const VolumeFunction& volume) {
  return {[volume](const RigidTransform& pose) { return volume(pose).m3; },
          [volume](const std::vector<RigidTransform>& poses) {
            std::vector<double> costs;
            for (const OccupiedVolume& one : volume.at(poses)) costs.push_back(one.m3);
            return costs;
          }};
}

}  // namespace croon
