#pragma once

#include <vector>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// The mean of the largest set of `values` that lie within `bound` of one number (adaptive voting;
/// Yang, Shi and Carlone, TEASER, T-RO 2021, section VI). `values` must not be empty.
double most_voted(std::vector<double> values, double bound);

/// The pose T_target_source that maps the points `source[i]` onto `target[i]`, some of which are
/// outliers and the others off by about `bound_m`: first the rotation with the minimum truncated
/// squares of differences between points, which are independent of the translation (graduated
/// non-convexity; Yang, Antonante, Tzoumas and Carlone, RA-L 2020), then each component of the
/// translation by most_voted (TEASER). Throws StageError for fewer than two points, or if the
/// inliers are collinear.
RigidTransform robust_pose(const Points& target, const Points& source, double bound_m);

}  // namespace croon
