#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/params/slot.hpp"
#include "framework/stage/volume_scorer.hpp"

namespace croon::test {

/// Every registered volume scorer, with its name.
std::vector<std::pair<std::string, params::Slot<VolumeScorer>>> all_scorers(double leaf_size_m);

/// A cloud of `points` alone.
std::shared_ptr<const Cloud> cloud_of(Points points);

/// Equation 9 word for word: the set of the leaves that hold a point of either cloud.
std::int64_t leaves_by_set(const Points& target, const Points& source,
                           const RigidTransform& T_target_source, double leaf_size_m);

/// Expects of every scorer the count of the set, at every pose.
void expect_equal_counts(const Points& target, const Points& source,
                         const std::vector<RigidTransform>& poses, double leaf_size_m);

}  // namespace croon::test
