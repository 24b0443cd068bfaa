#pragma once

#include "framework/params/choice.hpp"

namespace croon {

/// The M-estimators that weigh residuals.
enum class Kernel { none, huber, cauchy, geman_mcclure };

/// The choices of an ICP's parameter `kernel`.
inline const params::Words<Kernel> kKernelWords = {{"none", Kernel::none},
                                                   {"huber", Kernel::huber},
                                                   {"cauchy", Kernel::cauchy},
                                                   {"geman_mcclure", Kernel::geman_mcclure}};

/// The weight of a residual in iteratively reweighted least squares, `rho'(r) / r` of an
/// M-estimator, so that outliers pull little (Zhang 1997, "Parameter estimation techniques",
/// table 1).
class RobustKernel {
 public:
  /// `width` in the residual's unit: residuals above it begin to lose weight.
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

}  // namespace croon
