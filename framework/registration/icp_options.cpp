#include "framework/registration/icp_options.hpp"

#include <cmath>

namespace croon {

double RobustKernel::huber_weight(double squared_residual) const {
  return squared_residual <= width_ * width_ ? 1.0 : width_ / std::sqrt(squared_residual);
}

const params::Table<IcpOptions>& icp_table() {
  using params::choice;
  using params::integer;
  using params::number;
  using params::numbers;
  static const params::Table<IcpOptions> table = {
      numbers("max_distances_m", &IcpOptions::max_distances_m, {1e-6, 1e6},
              "Maximum distances between corresponding points; the registration converges at each "
              "in turn."),
      integer("max_iterations", &IcpOptions::max_iterations, {1, 10000},
              "Maximum number of iterations at each distance."),
      choice("kernel", &IcpOptions::kernel, kKernelWords,
             "The M-estimator that weights the residuals."),
      number("kernel_width_m", &IcpOptions::kernel_width_m, {1e-6, 1e6},
             "Larger residuals lose weight."),
      number("rotation_tolerance_deg", &IcpOptions::rotation_tolerance_deg, {0.0, 180.0},
             "Converged if an iteration rotates by at most this and moves by at most the "
             "translation tolerance."),
      number("translation_tolerance_m", &IcpOptions::translation_tolerance_m, {0.0, 1e6},
             "Converged if an iteration moves by at most this and rotates by at most the rotation "
             "tolerance."),
      integer(
          "max_coarse_points", &IcpOptions::max_coarse_points, {10, 1e9},
          "Maximum number of the sensor's points, evenly spaced, at all distances but the last, "
          "which uses all points.")
          .formerly("coarse_points"),
      integer("min_correspondences", &IcpOptions::min_correspondences, {6, 1e9},
              "Minimum number of correspondences; with fewer the registration fails."),
  };
  return table;
}

}  // namespace croon
