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

}  // namespace croon
