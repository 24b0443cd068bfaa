#pragma once

#include <array>
#include <vector>

#include "framework/registration/bundle_system.hpp"

namespace croon {

/// Classifies each degree of freedom of each sensor by how well the planes of a bundle adjustment
/// constrain it in its current state, with the other sensors fixed; `determined` for the first. The
/// uncertainty of a plane's normal follows from the distribution of its points, and random turns of
/// that size contribute information; in a direction that no surface constrains, all information is
/// this noise, for any number of scenes (see dof_constraints).
std::vector<DofObservability> plane_observability(const BundleSystem& system);

}  // namespace croon
