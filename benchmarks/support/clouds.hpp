#pragma once

#include <string>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon::benchmarks {

/// Two clouds of one place, each in its sensor's frame, and their relative pose.
struct CloudPair {
  std::string name;
  Points target;
  Points source;
  RigidTransform T_target_source;  ///< Ground truth, or the nominal pose of a recording without it.
};

/// A street (test/support), `target_count` points for the target and `source_count` for the source.
CloudPair street(int target_count, int source_count);

/// Streets with 1e3, 1e4 and 1e5 points in each cloud; up to CROON_BENCHMARK_POINTS, if set, but no
/// more than 1e7.
std::vector<CloudPair> streets();

/// Whether a pair is so large that a pose takes a second with a slow scorer.
bool is_large(const CloudPair& pair);

/// The first sensor of one CARLA and one real sample below the folder CROON_DATA; none if it is not
/// set.
std::vector<CloudPair> samples();

/// The first clouds of the rig `edgar` of GMMCalib, which has a nominal pose, below the folder
/// CROON_DATA/rigs; none if they are not there.
std::vector<CloudPair> rigs();

/// The pair without its ground, as the stage `ransac` finds it.
CloudPair non_ground(const CloudPair& pair);

/// A new cloud without cached data.
std::shared_ptr<const Cloud> fresh(const Points& points);

/// `count` reproducible poses within +-`rotation_deg` and +-`translation_m` per axis of the pair's
/// pose.
std::vector<RigidTransform> poses_near(const CloudPair& pair, int count, double rotation_deg,
                                       double translation_m);

}  // namespace croon::benchmarks
