#pragma once

#include <functional>

#include "framework/registration/gauss_newton.hpp"
#include "framework/registration/icp_options.hpp"
#include "framework/registration/registration.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// Which points correspond, beyond being nearest within the distance of the moment.
struct CorrespondenceRule {
  int target_normals = 0;  ///< Neighbours for normals of the target; 0: none are needed.
  int source_normals = 0;  ///< Likewise for the source.
  /// Least cosine between the two normals, where both are asked for; points without a normal do not
  /// correspond where one is needed.
  double min_normal_cosine = -2.0;
};

/// Adds what one correspondence contributes to the normal equations: a variant of ICP is this
/// function and its CorrespondenceRule.
using Linearise = std::function<void(const Correspondence&, const RobustKernel&, NormalEquations&)>;

/// The linearisation with the residual `n_t . (R s + t - p)` (Chen & Medioni 1992; paper,
/// refinement).
void linearise_point_to_plane(const Correspondence& pair, const RobustKernel& kernel,
                              NormalEquations& equations);

/// Iterates nearest-neighbour correspondences and Gauss-Newton steps (Besl & McKay 1992) over the
/// schedule of distances. Throws StageError where too few points correspond.
Registration iterate_icp(const Cloud& target, const Cloud& source, const RigidTransform& start,
                         const IcpOptions& options, const CorrespondenceRule& rule,
                         const Linearise& linearise);

}  // namespace croon
