#pragma once

#include <vector>

namespace croon::simulation {

/// Ascending places from `-extent_m` to `extent_m`: each of `wanted` that lies between, and others
/// 0.75 m apart near 0 and ever farther apart away from it.
std::vector<double> grid_lines(std::vector<double> wanted, double extent_m);

}  // namespace croon::simulation
