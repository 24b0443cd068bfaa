#pragma once

#include "framework/registration/bundle_system.hpp"

namespace croon {

/// What is not known of the present state of a bundle adjustment, by sensor, as adjust_bundle
/// documents it: that by clusters of planes, and what starts, velocities and clocks are
/// not known by. Zero for the first sensor and for those that are not free.
struct BundleUncertainty {
  std::vector<PoseCovariance> covariances;
  std::vector<double> clock_offset_stds_s;  ///< Zero unless the offsets are unknowns.
};
BundleUncertainty bundle_uncertainty(const BundleSystem& system, const BundleOptions& options);

}  // namespace croon
