#pragma once

#include "framework/base/rng.hpp"

namespace croon::simulation {

/// Smooth noise over the plane with a standard deviation of about 1 and features of about
/// `wavelength_m`: values at the corners of a square lattice, which follow from `key` and the
/// corner alone, and a smooth blend between (value noise).
double surface_noise(const StreamKey& key, double s_m, double d_m, double wavelength_m);

}  // namespace croon::simulation
