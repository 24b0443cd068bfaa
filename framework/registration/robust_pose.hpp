#pragma once

#include <vector>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// The rotation R with the least truncated squares of `target[i] - R source[i]` (lengths in m; the
/// square of a residual beyond `bound_m` counts as that of the bound), by graduated non-convexity
/// (Yang, Antonante, Tzoumas and Carlone, RA-L 2020) around the closed form of Horn and Arun
/// (weighted singular value decomposition). `target` and `source` are of one size. Throws
/// StageError if less than two of the vectors, which must not be parallel, remain.
Eigen::Matrix3d robust_rotation(const std::vector<Eigen::Vector3d>& target,
                                const std::vector<Eigen::Vector3d>& source, double bound_m);

/// The number within `bound` of which the most of `values` are: the mean of these (adaptive voting;
/// Yang, Shi and Carlone, TEASER, T-RO 2021, section VI). `values` must not be empty.
double most_voted(std::vector<double> values, double bound);

/// The pose T_target_source that maps the points `source[i]` onto `target[i]`, some of which may be
/// wrong by any distance, the others by about `bound_m`: the rotation from the differences between
/// points, which no translation changes, then each component of the translation by most_voted
/// (TEASER). Throws StageError as robust_rotation does.
RigidTransform robust_pose(const Points& target, const Points& source, double bound_m);

}  // namespace croon
