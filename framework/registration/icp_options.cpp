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
              "Points farther apart do not correspond; the registration converges at each distance "
              "in turn."),
      integer("max_iterations", &IcpOptions::max_iterations, {1, 10000},
              "Iterations at each distance, at most."),
      choice("kernel", &IcpOptions::kernel, kKernelWords,
             "The M-estimator that weighs the residuals."),
      number("kernel_width_m", &IcpOptions::kernel_width_m, {1e-6, 1e6},
             "Residuals above this begin to lose weight."),
      number("rotation_tolerance_deg", &IcpOptions::rotation_tolerance_deg, {0.0, 180.0},
             "Converged if an iteration turns by less than this and moves by less than the "
             "translation tolerance."),
      number("translation_tolerance_m", &IcpOptions::translation_tolerance_m, {0.0, 1e6},
             "Converged if an iteration moves by less than this and turns by less than the "
             "rotation tolerance."),
      integer(
          "coarse_points", &IcpOptions::coarse_points, {10, 1e9},
          "At most this many of the sensor's points, evenly spaced, are used at every distance but "
          "the last; all points are used at the last."),
      integer("min_correspondences", &IcpOptions::min_correspondences, {6, 1e9},
              "With fewer correspondences the registration fails."),
  };
  return table;
}

}  // namespace croon
