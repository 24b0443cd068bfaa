#pragma once

#include <vector>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// The number within `bound` of which the most of `values` are: the mean of these (adaptive voting;
/// Yang, Shi and Carlone, TEASER, T-RO 2021, section VI). `values` must not be empty.
double most_voted(std::vector<double> values, double bound);

/// The pose T_target_source that maps the points `source[i]` onto `target[i]`, some of which may be
/// wrong by any distance, the others by about `bound_m`: the rotation from the differences between
/// points, which no translation changes, with the least truncated squares (graduated non-convexity;
/// Yang, Antonante, Tzoumas and Carlone, RA-L 2020), then each component of the translation by
/// most_voted (TEASER). Throws StageError if the points that agree lie on one line, or less than
/// two are given.
RigidTransform robust_pose(const Points& target, const Points& source, double bound_m);

}  // namespace croon
