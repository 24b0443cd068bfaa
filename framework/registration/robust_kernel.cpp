#include "framework/registration/robust_kernel.hpp"

#include <cmath>

namespace croon {

double RobustKernel::huber_weight(double squared_residual) const {
  return squared_residual <= width_ * width_ ? 1.0 : width_ / std::sqrt(squared_residual);
}

}  // namespace croon
