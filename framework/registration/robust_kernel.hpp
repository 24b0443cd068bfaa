#pragma once

#include <string>
#include <vector>

namespace croon {

/// The choices of an ICP's parameter `kernel`.
inline const std::vector<std::string> kRobustKernels = {"none", "huber", "cauchy", "geman_mcclure"};

/// The weight of a residual in iteratively reweighted least squares, `rho'(r) / r` of an
/// M-estimator, so that points that lie off everything pull little (Zhang 1997, "Parameter
/// estimation techniques", table 1).
class RobustKernel {
 public:
  /// `name` is one of kRobustKernels; `width` in the residual's unit is where it begins to bite.
  RobustKernel(const std::string& name, double width);

  /// In [0, 1]; 1 for a residual of zero.
  double weight(double squared_residual) const {
    switch (shape_) {
      case Shape::none:
        return 1.0;
      case Shape::huber:
        return huber_weight(squared_residual);
      case Shape::cauchy:
        return 1.0 / (1.0 + squared_residual * inverse_squared_width_);
      case Shape::geman_mcclure: {
        const double share = 1.0 / (1.0 + squared_residual * inverse_squared_width_);
        return share * share;
      }
    }
    return 1.0;
  }

 private:
  enum class Shape { none, huber, cauchy, geman_mcclure };
  double huber_weight(double squared_residual) const;

  Shape shape_;
  double width_;
  double inverse_squared_width_;
};

}  // namespace croon
