#include "framework/registration/robust_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace croon {

RobustKernel::RobustKernel(const std::string& name, double width)
    : width_(width), inverse_squared_width_(1.0 / (width * width)) {
  const auto found = std::find(kRobustKernels.begin(), kRobustKernels.end(), name);
  if (found == kRobustKernels.end()) throw std::logic_error("no robust kernel \"" + name + "\"");
  shape_ = static_cast<Shape>(found - kRobustKernels.begin());
}

double RobustKernel::huber_weight(double squared_residual) const {
  return squared_residual <= width_ * width_ ? 1.0 : width_ / std::sqrt(squared_residual);
}

}  // namespace croon
