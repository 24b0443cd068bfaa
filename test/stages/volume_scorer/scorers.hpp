#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/params/slot.hpp"
#include "framework/stage/leaf_scorer.hpp"

namespace croon::test {

/// Leaves of one size, on one lattice.
LeafOptions leaves_of(double leaf_size_m);

/// Every registered volume scorer that counts leaves, with its name.
std::vector<std::pair<std::string, params::Slot<VolumeScorer>>> all_scorers(
    const LeafOptions& options);
inline auto all_scorers(double leaf_size_m) { return all_scorers(leaves_of(leaf_size_m)); }

/// A cloud of `points` alone.
std::shared_ptr<const Cloud> cloud_of(Points points);

/// Equation 9 word for word: the set of the leaves that hold a point of either cloud.
std::int64_t leaves_by_set(const Points& target, const Points& source,
                           const RigidTransform& T_target_source, double leaf_size_m);

/// What LeafOptions say, word for word: sets of leaves.
OccupiedVolume volume_by_sets(const Points& target, const Points& source,
                              const RigidTransform& T_target_source, const LeafOptions& options);

/// Expects of every scorer the count of the sets, at every pose.
void expect_equal_counts(const Points& target, const Points& source,
                         const std::vector<RigidTransform>& poses, const LeafOptions& options);
inline void expect_equal_counts(const Points& target, const Points& source,
                                const std::vector<RigidTransform>& poses, double leaf_size_m) {
  expect_equal_counts(target, source, poses, leaves_of(leaf_size_m));
}

}  // namespace croon::test
