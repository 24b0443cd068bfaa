#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/registration/gauss_newton.hpp"
#include "framework/registration/icp_options.hpp"
#include "framework/registration/registration.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// Correspondences in the order of the source's points.
using Correspondences = std::vector<Correspondence>;

/// Removes correspondences of one iteration, or changes their weights; the order must stay. It sees
/// all of them at once, e.g. to keep the best 70 %, or one for each point of the target.
using SelectCorrespondences = std::function<void(Correspondences&)>;

/// The minimum cosine of two unit vectors that are at most `max_angle_deg` apart; below all cosines
/// for 180 degrees, because the length of a float vector is not exactly one.
inline double min_cosine_within(double max_angle_deg) {
  return max_angle_deg < 180.0 ? std::cos(rad_from_deg(max_angle_deg)) : -2.0;
}

/// The conditions for correspondences, in addition to being nearest within the current distance.
struct CorrespondenceRule {
  int target_normals = 0;  ///< Neighbours for the target's normals; 0: normals are not needed.
  int source_normals = 0;  ///< Likewise for the source.
  /// The minimum cosine between the two normals, if both are needed. Points without a needed normal
  /// do not correspond.
  double min_normal_cosine = -2.0;
  SelectCorrespondences select = nullptr;  ///< Null: all correspondences are used.
};

/// Adds the contributions of some correspondences to the normal equations. A variant of ICP
/// consists of such a function and a CorrespondenceRule.
using Linearise =
    std::function<void(const Correspondences&, const RobustKernel&, NormalEquations&)>;

/// The same from a function of one correspondence, `linearise(pair, kernel, equations)`, which the
/// compiler inlines. The weight of the correspondence applies to everything that it adds.
template <class Function>
Linearise for_each_correspondence(Function linearise) {
  return [linearise](const Correspondences& pairs, const RobustKernel& kernel,
                     NormalEquations& equations) {
    for (const Correspondence& pair : pairs) {
      equations.factor = pair.weight;
      linearise(pair, kernel, equations);
    }
  };
}

/// The linearisation with the residual `n_t . (R s + t - p)` (Chen & Medioni 1992; paper,
/// refinement).
Linearise point_to_plane_linearisation();

/// Iterates nearest-neighbour correspondences and Gauss-Newton steps (Besl & McKay 1992) over the
/// schedule of distances. Throws StageError if too few points correspond.
Registration iterate_icp(const Cloud& target, const Cloud& source, const RigidTransform& start,
                         const IcpOptions& options, const CorrespondenceRule& rule,
                         const Linearise& linearise);

}  // namespace croon
