#pragma once

#include "framework/registration/bundle_system.hpp"

namespace croon {

/// The covariances of the poses in the present state of a bundle adjustment, by sensor, as
/// adjust_bundle documents them: the jackknife over clusters of planes, and what the starts and the
/// velocities are not known by. Zero for the first sensor and for those that are not free.
std::vector<PoseCovariance> bundle_covariances(const BundleSystem& system,
                                               const BundleOptions& options);

}  // namespace croon
