#pragma once

#include <array>
#include <vector>

#include "framework/registration/bundle_system.hpp"

namespace croon {

/// How well the planes of a bundle adjustment hold each degree of freedom of each sensor in its
/// present state, with the other sensors as they are; `determined` for the first. A plane's normal
/// is known as well as its points let it be turned, and turns by so much at random; in a direction
/// that no surface holds, all that planes say of it is this noise, however many scenes there are
/// (see held_dofs).
std::vector<DofWords> plane_words(const BundleSystem& system);

}  // namespace croon
