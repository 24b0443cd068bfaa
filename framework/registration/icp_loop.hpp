#pragma once

#include <functional>

#include "framework/registration/gauss_newton.hpp"
#include "framework/registration/icp_options.hpp"
#include "framework/registration/registration.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// Which points correspond, in addition to being nearest within the current distance.
struct CorrespondenceRule {
  int target_normals = 0;  ///< Neighbours for the target's normals; 0: no normals are needed.
  int source_normals = 0;  ///< Likewise for the source.
  /// The smallest cosine between the two normals, if both are needed. Points without a needed
  /// normal do not correspond.
  double min_normal_cosine = -2.0;
};

/// Adds the contribution of one correspondence to the normal equations. A variant of ICP is such a
/// function and a CorrespondenceRule.
using Linearise = std::function<void(const Correspondence&, const RobustKernel&, NormalEquations&)>;

/// The linearisation with the residual `n_t . (R s + t - p)` (Chen & Medioni 1992; paper,
/// refinement).
void linearise_point_to_plane(const Correspondence& pair, const RobustKernel& kernel,
                              NormalEquations& equations);

/// Iterates nearest-neighbour correspondences and Gauss-Newton steps (Besl & McKay 1992) over the
/// schedule of distances. Throws StageError if too few points correspond.
Registration iterate_icp(const Cloud& target, const Cloud& source, const RigidTransform& start,
                         const IcpOptions& options, const CorrespondenceRule& rule,
                         const Linearise& linearise);

}  // namespace croon
