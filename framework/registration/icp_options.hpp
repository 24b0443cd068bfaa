#pragma once

#include <vector>

#include "framework/params/choice.hpp"
#include "framework/params/table.hpp"

namespace croon {

/// The M-estimators that weight residuals.
enum class Kernel { none, huber, cauchy, geman_mcclure };

/// The choices of an ICP's parameter `kernel`.
inline const params::Words<Kernel> kKernelWords = {{"none", Kernel::none},
                                                   {"huber", Kernel::huber},
                                                   {"cauchy", Kernel::cauchy},
                                                   {"geman_mcclure", Kernel::geman_mcclure}};

/// The weight of a residual in iteratively reweighted least squares, `rho'(r) / r` of an
/// M-estimator, which reduces the influence of outliers (Zhang 1997, "Parameter estimation
/// techniques", table 1).
class RobustKernel {
 public:
  /// `width` in the residual's unit: larger residuals lose weight.
  RobustKernel(Kernel kernel, double width)
      : kernel_(kernel), width_(width), inverse_squared_width_(1.0 / (width * width)) {}

  /// In [0, 1]; 1 for a residual of zero.
  double weight(double squared_residual) const {
    switch (kernel_) {
      case Kernel::none:
        return 1.0;
      case Kernel::huber:
        return huber_weight(squared_residual);
      case Kernel::cauchy:
        return 1.0 / (1.0 + squared_residual * inverse_squared_width_);
      case Kernel::geman_mcclure: {
        const double share = 1.0 / (1.0 + squared_residual * inverse_squared_width_);
        return share * share;
      }
    }
    return 1.0;
  }

 private:
  double huber_weight(double squared_residual) const;

  Kernel kernel_;
  double width_;
  double inverse_squared_width_;
};

/// The parameters common to all variants of ICP. A variant's own `Params` derives from this and its
/// table inherits icp_table().
struct IcpOptions {
  std::vector<double> max_distances_m = {1.0, 0.5, 0.3};
  int max_iterations = 20;
  Kernel kernel = Kernel::geman_mcclure;
  double kernel_width_m = 0.1;
  double rotation_tolerance_deg = 0.0005;
  double translation_tolerance_m = 0.00005;
  int max_coarse_points = 3000;
  int min_correspondences = 30;
};

/// The rows of IcpOptions.
const params::Table<IcpOptions>& icp_table();

}  // namespace croon
