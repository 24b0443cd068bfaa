#pragma once

#include <vector>

#include "framework/params/table.hpp"
#include "framework/registration/robust_kernel.hpp"

namespace croon {

/// The parameters that every ICP has. A variant's own `Params` derives from this and its table
/// inherits icp_table().
struct IcpOptions {
  std::vector<double> max_distances_m = {1.0, 0.5, 0.3};
  int max_iterations = 20;
  Kernel kernel = Kernel::geman_mcclure;
  double kernel_width_m = 0.1;
  double rotation_tolerance_deg = 0.0005;
  double translation_tolerance_m = 0.00005;
  int coarse_points = 3000;
  int min_correspondences = 30;
};

/// The rows of IcpOptions.
const params::Table<IcpOptions>& icp_table();

}  // namespace croon
